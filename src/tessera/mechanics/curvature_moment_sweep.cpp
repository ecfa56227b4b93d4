#include "tessera/mechanics/curvature_nodes.hpp"

namespace tessera {

namespace {

/// Sums of what senders have sent.
struct Received {
  Double8 pairs[4]{};
  Double4 last{};

  void add(const SentMoments& sent) {
    unrolled<4>([&](auto i) {
      Double8 pair;
      __builtin_memcpy(&pair, sent.v + 2 * i, sizeof pair);
      pairs[i] += pair;
    });
    last += sent.v[8];
  }

  template <Index i>
  Double4 vector() const {
    if constexpr (i == 8)
      return last;
    else if constexpr (i % 2 == 0)
      return __builtin_shufflevector(pairs[i / 2], pairs[i / 2], 0, 1, 2, 3);
    else
      return __builtin_shufflevector(pairs[i / 2], pairs[i / 2], 4, 5, 6, 7);
  }

  /// What that does to V_b T_b of the cell with this centroid.
  Columns tensor(const Double4& C) const {
    Double4 column[3];
    unrolled<3>([&](auto j) {
      const Double4 Z0 = vector<j>(), Z1 = vector<3 + j>(), Z2 = vector<6 + j>();
      const Double4 own = __builtin_shufflevector(__builtin_shufflevector(Z0, Z1, 3, 7, 3, 7), Z2, 0, 1, 7, 7);
      column[j] = C[0] * Z0 + C[1] * Z1 + C[2] * Z2 - own;
    });
    return {column[0], column[1], column[2]};
  }
};

/// What the moments of the tile's own cells do to F'_b: sum_a Z_a C_ab of the cells that have b as a neighbour, [J].
inline void return_gradient_moments(const System& s, Index k, CurvatureScratch& scratch, Tensor* __restrict rim) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const CurvatureRows& rows = s.second_order->rows;
  const std::uint16_t* count = rows.sender_count.data() + tile.node;
  const std::uint16_t* sender = rows.senders.data() + RowReader::start(s, k).neighbour;
  const SentMoments* moments = scratch.moments.data();
  const Double4* C = scratch.centroid.data();
  const auto received = [&](Index local) {
    Received sum;
    for (const std::uint16_t* end = sender + count[local]; sender != end; ++sender) sum.add(moments[*sender]);
    return sum.tensor(C[local]);
  };
  const double* volume = s.d.volume.data() + tile.begin;
  Columns* __restrict T = scratch.T.data();
  for (Index a = 0; a < own; ++a) T[a] = T[a] + (1.0 / volume[a]) * received(a);
  for (Index i = 0; i < rim_size; ++i) store(rim[tile.rim + i], received(own + i));
}

}  // namespace

TESSERA_KERNEL void curvature_moment_sweep(const System& s, Index k, const Tensor* T, const Hessian* moment,
                                           CurvatureScratch& scratch, Tensor* T_first, Tensor* rim) {
  struct Node {
    Double4 T[3];  // columns, each with a component of the position
    Double4 g[derivatives];
  };
  Node* __restrict nodes = reinterpret_cast<Node*>(scratch.nodes.data());
  Double4* __restrict centroid = scratch.centroid.data();
  const Vec3 *X = s.d.X.data(), *C = s.d.measure->centroid.data();
  const Double4 C_0 = to_kernel(C[tile_of(s, k).begin]);
  for_each_node(
      s, k,
      [&](Index local, Index b) {
        put_columns(T[b], X[b], nodes[local].T);
        put_vectors(moment[b], nodes[local].g);
        centroid[local] = to_kernel(C[b]) - C_0;
      },
      [&](Index b) { fetch(T + b), fetch_all(moment + b), fetch(X + b), fetch(C + b); });
  RowReader rows(s, k);
  const double* volume = s.d.volume.data() + rows.tile.begin;
  const Vec3* offset = s.second_order->rows.offset.data() + rows.tile.begin;
  for (Index row = 0; row < rows.tile.size(); ++row, rows.next(), ++offset) {
    const Node a = nodes[row];
    Double4 g[derivatives];
    unrolled<derivatives>([&](auto r) { g[r] = a.g[r]; });
    rows.for_each_neighbour(
        [&](const CurvatureRows::Neighbour& n) {
          const Node& b = nodes[n.cell];
          const CurvatureRows::FaceFactors& M = rows.M[n.face];
          Double4 difference[3], t{};
          unrolled<3>([&](auto j) { difference[j] = b.T[j] - a.T[j]; });
          unrolled<3>([&](auto j) { t += fourth(difference[j]) * difference[j]; });
          unrolled<derivatives>([&](auto r) { g[r] += b.g[r] - M[std::size_t{r}] * t; });
        },
        reinterpret_cast<const double*>(rows.next_M), rows.map);
    Double4 Z[3][3]{};
    unrolled<derivatives>([&](auto r) {
      unrolled<3>([&](auto j) { unrolled<3>([&](auto l) { Z[l][j] += rows.map[9 * r + 3 * j + l] * g[r]; }); });
    });
    const Double4 C_a = centroid[row];
    const double inverse_volume = 1.0 / volume[row];
    SentMoments& sent = scratch.moments[static_cast<std::size_t>(row)];
    Double4 first[3];
    unrolled<3>([&](auto j) {
      const Double4 own = C_a[0] * Z[0][j] + C_a[1] * Z[1][j] + C_a[2] * Z[2][j];
      unrolled<3>([&](auto l) { sent.v[3 * l + j] = with_fourth(Z[l][j], own[Index{l}]); });
      first[j] = a.T[j] - inverse_volume * (offset->x * Z[0][j] + offset->y * Z[1][j] + offset->z * Z[2][j]);
    });
    scratch.T[static_cast<std::size_t>(row)] = {first[0], first[1], first[2]};
  }
  return_gradient_moments(s, k, scratch, rim);
  for (Index a = 0; a < rows.tile.size(); ++a)
    store(T_first[rows.tile.begin + a], scratch.T[static_cast<std::size_t>(a)]);
}

}  // namespace tessera
