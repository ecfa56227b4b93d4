#pragma once

#include <algorithm>

#include "tessera/base/fetch.hpp"
#include "tessera/base/kernel.hpp"
#include "tessera/mechanics/sweeps.hpp"

// What the kernels of the sweeps share: values of a tile and its rim by local numbers, four particles at a time.

namespace tessera {

constexpr Index quad = 4;

// How far ahead values of the rim are fetched: their addresses jump, so the processor cannot foresee them.
constexpr Index lookahead = 8;

inline const Tile& tile_of(const System& s, Index tile) { return s.tiles.tiles[static_cast<std::size_t>(tile)]; }

/// Writes a tensor column by column; each of the first two stores overlaps the next.
inline void store(Tensor& to, const Columns& t) {
  __builtin_memcpy(to.m, &t.c0, sizeof(Double4));
  __builtin_memcpy(to.m + 3, &t.c1, sizeof(Double4));
  const Double2 most = __builtin_shufflevector(t.c2, t.c2, 0, 1);
  __builtin_memcpy(to.m + 6, &most, sizeof most);
  to.m[8] = t.c2[2];
}

/// Copies what sweeps need of the tile and its rim.
inline void fill_nodes(const System& s, Index k, const Double4* x, const Tensor* F, TileNode* __restrict nodes) {
  const Tile& tile = tile_of(s, k);
  const Vec3* X = s.d.X.data();
  const auto fill = [&](TileNode& node, Index b) {
    for (int i = 0; i < 9; ++i) node.value[i] = 0.5 * F[b].m[i];
    for (int i = 0; i < 3; ++i) node.value[9 + i] = x[b][i];
    node.value[12] = X[b].x, node.value[13] = X[b].y, node.value[14] = X[b].z;
  };
  for (Index b = tile.begin; b < tile.end; ++b) {
    fetch_ahead<2880>(F + b);
    fetch_ahead<2048>(x + b);
    fetch_ahead<2048>(X + b);
    fill(nodes[b - tile.begin], b);
  }
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  for (Index i = 0; i < rim_size; ++i) {
    const Index ahead = rim[std::min(i + lookahead, rim_size - 1)];
    fetch(F + ahead);
    fetch(x + ahead);
    fetch(X + ahead);
    fill(nodes[own + i], rim[i]);
  }
}

inline Lanes9 to_lanes(const Tensor& a, const Tensor& b, const Tensor& c, const Tensor& d) {
  const auto pairs = [&](Index k) { return load_pairs(a.m + k, b.m + k, c.m + k, d.m + k); };
  const TwoLanes p0 = pairs(0), p2 = pairs(2), p4 = pairs(4), p6 = pairs(6);
  const Double4 p8{a.m[8], b.m[8], c.m[8], d.m[8]};
  return {p0.first, p2.second, p6.first, p0.second, p4.first, p6.second, p2.first, p4.second, p8};
}

/// Several tensors, each a row of nine numbers.
template <class Lanes>
inline Lanes9Of<Lanes> lanes_of_rows(const double* const (&row)[lanes_in<Lanes>]) {
  const FourOf<Lanes> m0 = load_fours(row, 0), m4 = load_fours(row, 4), m5 = load_fours(row, 5);
  return {m0.n0, m0.n3, m4.n2, m0.n1, m4.n0, m4.n3, m0.n2, m4.n1, m5.n3};
}

/// Adds the viscous stress of particle a, [D 61, 62], to P; returns the work that it has taken since the last time [J].
inline double add_viscous_stress(const System& s, Index a, const Tensor& F, ViscousMemory& viscous, double dt,
                                 Columns& P) {
  const auto k = static_cast<std::size_t>(a);
  const Mat3 F_a = to_mat3(F), dF = F_a - to_mat3(viscous.F_previous[k]);
  const Mat3 P_viscous = viscous_stress(s.viscosity[k], F_a, (1.0 / dt) * dF);
  const double work = 0.5 * s.d.volume[k] * contract(P_viscous + to_mat3(viscous.P_previous[k]), dF);
  viscous.P_previous[k] = to_tensor(P_viscous);
  P = P + to_kernel(P_viscous);
  return work;
}

inline Lanes9 to_lanes(const Columns& a, const Columns& b, const Columns& c, const Columns& d) {
  const Lanes3 c0 = transposed(a.c0, b.c0, c.c0, d.c0), c1 = transposed(a.c1, b.c1, c.c1, d.c1),
               c2 = transposed(a.c2, b.c2, c.c2, d.c2);
  return {c0.x, c1.x, c2.x, c0.y, c1.y, c2.y, c0.z, c1.z, c2.z};
}

/// Calls body(law), with the flow of a plastic law held where it is to be.
template <class Laws, class Body>
inline auto visit_law(const Laws& laws, Flow flow, Body&& body) {
  return std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.held(); })
          return body(flow == Flow::held ? law.held() : law);
        else
          return body(law);
      },
      laws);
}

/// Four tensors column by column.
struct FourColumns {
  Columns t[4];
};

inline FourColumns columns_of(const Lanes9& l) {
  const FourVectors c0 = transposed(Lanes3{l.xx, l.yx, l.zx}), c1 = transposed(Lanes3{l.xy, l.yy, l.zy}),
                    c2 = transposed(Lanes3{l.xz, l.yz, l.zz});
  FourColumns four;
  for (int k = 0; k < 4; ++k) four.t[k] = {c0.v[k], c1.v[k], c2.v[k]};
  return four;
}

/// Several tensors column by column.
template <class Lanes>
struct ColumnsOf {
  explicit ColumnsOf(const Lanes9Of<Lanes>& l) {
    if constexpr (lanes_in<Lanes> == 4) {
      const FourColumns four = columns_of(l);
      std::copy(four.t, four.t + 4, t);
    } else {
      const FourColumns first = columns_of(half(l, first_half)), second = columns_of(half(l, second_half));
      std::copy(first.t, first.t + 4, t);
      std::copy(second.t, second.t + 4, t + 4);
    }
  }
  template <class Half>
  static Lanes9 half(const Lanes9Of<Lanes>& l, const Half& h) {
    return {h(l.xx), h(l.xy), h(l.xz), h(l.yx), h(l.yy), h(l.yz), h(l.zx), h(l.zy), h(l.zz)};
  }
  Columns t[lanes_in<Lanes>];
};

}  // namespace tessera
