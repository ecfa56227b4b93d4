#include "tessera/mechanics/hessians.hpp"

#include <algorithm>
#include <utility>

#include "tessera/mechanics/system.hpp"
#include "tessera/mechanics/tile_nodes.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

constexpr Index derivatives = 6;                // xx, xy, xz, yy, yz, zz
constexpr Index components = 3 * derivatives;   // of a Hessian
constexpr Index map_numbers = 9 * derivatives;  // of S_a
constexpr Index gradient_node = 12;             // F and the centroid
constexpr Index hessian_node = components + 4;  // q H, the position, one number that means nothing
constexpr Index moment_node = components + 12;  // T, G / sum q, the position

std::array<double, derivatives> factors(const Symmetric3& m) {
  return {m.xx, 2.0 * m.xy, 2.0 * m.xz, m.yy, 2.0 * m.yz, m.zz};
}

/// Fills the arrays of one tile.
class TileRows {
 public:
  TileRows(const Discretization& d, const Tiles& t, CurvatureRows& rows)
      : d_(d), s_(*d.second_order), t_(t), r_(rows) {}

  void fill(const Tile& tile) {
    constants(tile);
    const auto bonds_of = [&](Index a) { return static_cast<Index>(d_.bonds.end(a) - d_.bonds.begin(a)); };
    for_each_slot(t_, tile, bonds_of, [&](Offset slot, Index a, Index i) { slot_of(tile, slot, a, i); });
    Offset slot = tile.slot;
    for (Index q = 0; q < tile.quads(); ++q) {
      const Offset quad_number = tile.quad + q;
      CurvatureRows::Constants& c = r_.constants[static_cast<std::size_t>(quad_number)];
      for (Index i = 0; i < quad * t_.length[static_cast<std::size_t>(quad_number)]; ++i, ++slot) {
        const Index lane = i % quad;
        if (r_.near[static_cast<std::size_t>(slot)] == local(quad_number, lane)) c.repeated[lane] -= 1.0;
      }
    }
  }

 private:
  std::uint16_t local(Offset quad_number, Index lane) const {
    return t_.order[static_cast<std::size_t>(quad * quad_number + lane)];
  }

  void constants(const Tile& tile) {
    for (Index q = 0; q < tile.quads(); ++q) {
      CurvatureRows::Constants& c = r_.constants[static_cast<std::size_t>(tile.quad + q)];
      c = CurvatureRows::Constants{};
      c.repeated += 1.0;
      for (Index lane = 0; lane < quad; ++lane) {
        const Index a = tile.begin + local(tile.quad + q, lane);
        const auto k = static_cast<std::size_t>(a);
        c.weight[lane] = s_.derivatives.weight[k];
        c.inverse_sum[lane] = r_.inverse_sum[k];
        const Vec3 sum = offset(a);
        for (int j = 0; j < 3; ++j) c.offset[j][lane] = sum[j];
        for (Index m = 0; m < map_numbers; ++m)
          r_.map[static_cast<std::size_t>(map_numbers * (tile.quad + q) + m)][lane] =
              s_.derivatives.map[k][static_cast<std::size_t>(m)];
      }
    }
  }

  Vec3 offset(Index a) const {
    Vec3 sum;
    for (Offset i = d_.bonds.begin(a); i < d_.bonds.end(a); ++i)
      if (const auto k = static_cast<std::size_t>(i); d_.bonds.area_over_length[k] > 0.0)
        sum += d_.measure->centroid[static_cast<std::size_t>(d_.bonds.neighbour[k])] -
               d_.measure->centroid[static_cast<std::size_t>(a)];
    return sum;
  }

  void slot_of(const Tile& tile, Offset slot, Index a, Index i) {
    const auto k = static_cast<std::size_t>(slot);
    const auto bond = static_cast<std::size_t>(d_.bonds.begin(a) + std::max<Index>(i, 0));
    const bool face = i >= 0 && d_.bonds.area_over_length[bond] > 0.0;
    r_.near[k] = face ? t_.neighbour[k] : static_cast<std::uint16_t>(a - tile.begin);
    std::array<double, derivatives> m{};
    if (face) {
      const double sum = s_.derivatives.weight[static_cast<std::size_t>(a)] +
                         s_.derivatives.weight[static_cast<std::size_t>(d_.bonds.neighbour[bond])];
      if (sum > 0.0) m = factors((d_.bonds.area_over_length[bond] / sum) * s_.M[bond]);
    }
    for (Index r = 0; r < derivatives; ++r)
      r_.M[static_cast<std::size_t>(derivatives * (slot / quad) + r)][slot % quad] = m[static_cast<std::size_t>(r)];
  }

  const Discretization& d_;
  const SecondOrder& s_;
  const Tiles& t_;
  CurvatureRows& r_;
};

}  // namespace

CurvatureRows curvature_rows(const Discretization& d, const Tiles& tiles) {
  CurvatureRows rows;
  const std::vector<double>& weight = d.second_order->derivatives.weight;
  rows.inverse_sum.resize(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    if (weight[a] == 0.0) return;
    double sum = weight[a];
    for (Offset k = d.bonds.begin(static_cast<Index>(i)); k < d.bonds.end(static_cast<Index>(i)); ++k)
      if (const auto bond = static_cast<std::size_t>(k); d.bonds.area_over_length[bond] > 0.0)
        sum += weight[static_cast<std::size_t>(d.bonds.neighbour[bond])];
    rows.inverse_sum[a] = 1.0 / sum;
  });
  const Tile& end = tiles.tiles.back();
  rows.near.resize(static_cast<std::size_t>(end.slot));
  rows.M.resize(static_cast<std::size_t>(derivatives * end.slot / quad));
  rows.map.resize(static_cast<std::size_t>(map_numbers * end.quad));
  rows.constants.resize(static_cast<std::size_t>(end.quad));
  rows.surfaces = d.second_order->surfaces;
  parallel::for_tasks(tiles.size(),
                      [&](std::int64_t k) { TileRows(d, tiles, rows).fill(tiles.tiles[static_cast<std::size_t>(k)]); });
  return rows;
}

CurvatureScratch::CurvatureScratch(const Tiles& tiles)
    : nodes(static_cast<std::size_t>(moment_node * tiles.most_nodes)),
      centroid(static_cast<std::size_t>(tiles.most_nodes)),
      moments(static_cast<std::size_t>(tiles.most_particles)),
      T(static_cast<std::size_t>(tiles.most_particles)) {}

namespace {

/// Where the data of a tile's four particles are.
struct Quads {
  Quads(const System& s, Index k)
      : tile(tile_of(s, k)),
        order(s.tiles.order.data() + quad * tile.quad),
        length(s.tiles.length.data() + tile.quad),
        near(s.second_order->rows.near.data() + tile.slot),
        M(s.second_order->rows.M.data() + derivatives * (tile.slot / quad)),
        map(s.second_order->rows.map.data() + map_numbers * tile.quad),
        constants(s.second_order->rows.constants.data() + tile.quad) {}

  void next() { order += quad, map += map_numbers, ++constants, ++length; }
  void next_slot() { near += quad, M += derivatives; }

  const Tile& tile;
  const std::uint16_t* order;
  const std::uint16_t* length;
  const std::uint16_t* near;
  const Double4* M;
  const Double4* map;
  const CurvatureRows::Constants* constants;
};

/// Calls fill(local, particle) for the tile and its rim, and ahead(particle) for what is filled later.
template <class Fill, class Ahead>
inline void for_each_node(const System& s, Index k, Fill&& fill, Ahead&& ahead) {
  const Tile& tile = tile_of(s, k);
  for (Index b = tile.begin; b < tile.end; ++b) fill(b - tile.begin, b);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  for (Index i = 0; i < rim_size; ++i) {
    ahead(rim[std::min(i + lookahead, rim_size - 1)]);
    fill(own + i, rim[i]);
  }
}

/// Calls body(k) for k = 0 to n - 1, each a constant, so that what it indexes stays in registers.
template <Index n, class Body>
inline void unrolled(Body&& body) {
  const auto call = [&]<Index... k>(std::integer_sequence<Index, k...>) {
    (body(std::integral_constant<Index, k>{}), ...);
  };
  call(std::make_integer_sequence<Index, n>{});
}

/// `n` numbers of four nodes, an even number.
template <Index n>
inline void load_numbers(const double* nodes, Index stride, const std::uint16_t* local, Double4 (&to)[n]) {
  const double *n0 = nodes + stride * local[0], *n1 = nodes + stride * local[1], *n2 = nodes + stride * local[2],
               *n3 = nodes + stride * local[3];
  unrolled<n / 2>([&](auto i) {
    constexpr Index k = 2 * i;
    const TwoLanes pair = load_pairs(n0 + k, n1 + k, n2 + k, n3 + k);
    to[k] = pair.first, to[k + 1] = pair.second;
  });
}

inline void put(double* to, const Vec3& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

/// Numbers 3 r + i of four particles into their Hessians.
inline void store_hessians(const Tile& tile, Index q, const std::uint16_t* order, const Double4 (&h)[components],
                           Hessian* to) {
  const Index lanes = std::min(quad, tile.size() - quad * q);
  for (Index lane = 0; lane < lanes; ++lane) {
    Hessian& result = to[tile.begin + order[lane]];
    for (Index k = 0; k < components; ++k) result.h[k] = h[k][lane];
  }
}

}  // namespace

TESSERA_KERNEL void hessian_sweep(const System& s, Index k, const Tensor* F, CurvatureScratch& scratch,
                                  Hessian* weighted) {
  double* nodes = scratch.nodes.data();
  const Vec3* C = s.d.measure->centroid.data();
  for_each_node(
      s, k,
      [&](Index local, Index b) {
        double* node = nodes + gradient_node * local;
        for (int i = 0; i < 9; ++i) node[i] = F[b].m[i];
        put(node + 9, C[b]);
      },
      [&](Index b) { fetch(F + b), fetch(C + b); });
  Quads rows(s, k);
  for (Index q = 0; q < rows.tile.quads(); ++q, rows.next()) {
    Double4 own[gradient_node], G[3][9]{};  // for each component of C a tensor, column by column
    load_numbers(nodes, gradient_node, rows.order, own);
    for (Index i = 0; i < *rows.length; ++i, rows.near += quad) {
      Double4 b[gradient_node];
      load_numbers(nodes, gradient_node, rows.near, b);
      unrolled<9>([&](auto m) { b[m] -= own[m]; });
      unrolled<3>([&](auto l) {
        const Double4 C = b[9 + l] - own[9 + l];
        unrolled<9>([&](auto m) { G[l][m] += C * b[m]; });
      });
    }
    Double4 h[components];
    unrolled<derivatives>([&](auto r) {
      Double4 sum[3]{};
      unrolled<9>([&](auto k) {
        constexpr Index j = k / 3, l = k % 3;
        const Double4 S = rows.map[9 * r + k];
        unrolled<3>([&](auto i) { sum[i] += S * G[l][3 * j + i]; });
      });
      unrolled<3>([&](auto i) { h[3 * r + i] = rows.constants->weight * sum[i]; });
    });
    store_hessians(rows.tile, q, rows.order, h, weighted);
  }
}

TESSERA_KERNEL void curvature_strain_sweep(const System& s, Index k, const Hessian* weighted, CurvatureScratch& scratch,
                                           Tensor* F, Hessian* mean) {
  double* nodes = scratch.nodes.data();
  const Vec3* X = s.d.X.data();
  for_each_node(
      s, k,
      [&](Index local, Index b) {
        double* node = nodes + hessian_node * local;
        for (Index i = 0; i < components; ++i) node[i] = weighted[b].h[i];
        put(node + components, X[b]);
      },
      [&](Index b) { fetch(weighted + b), fetch(X + b); });
  Quads rows(s, k);
  const double* volume = s.d.volume.data() + rows.tile.begin;
  for (Index q = 0; q < rows.tile.quads(); ++q, rows.next()) {
    Double4 own[hessian_node], sum[components]{}, VF[9]{};
    load_numbers(nodes, hessian_node, rows.order, own);
    for (Index i = 0; i < *rows.length; ++i, rows.next_slot()) {
      Double4 b[hessian_node], c[3]{};
      load_numbers(nodes, hessian_node, rows.near, b);
      unrolled<derivatives>([&](auto r) {
        const Double4 M = rows.M[r];
        unrolled<3>([&](auto m) {
          sum[3 * r + m] += b[3 * r + m];
          c[m] += M * (own[3 * r + m] + b[3 * r + m]);
        });
      });
      unrolled<3>([&](auto j) {
        const Double4 x = b[components + j] - own[components + j];
        unrolled<3>([&](auto m) { VF[3 * j + m] += x * c[m]; });
      });
    }
    const CurvatureRows::Constants& constants = *rows.constants;
    unrolled<components>([&](auto m) { sum[m] = constants.inverse_sum * (sum[m] + constants.repeated * own[m]); });
    store_hessians(rows.tile, q, rows.order, sum, mean);
    const Index lanes = std::min(quad, rows.tile.size() - quad * q);
    for (Index lane = 0; lane < lanes; ++lane) {
      const Index local = rows.order[lane];
      const double inverse_volume = 1.0 / volume[local];
      for (int m = 0; m < 9; ++m) F[rows.tile.begin + local].m[m] += inverse_volume * VF[m][lane];
    }
  }
}

namespace {

/// What the moments of the tile's own cells do to F'_b: sum_a Z_a C_ab of the bonds that lead to b, [J].
inline void return_gradient_moments(const System& s, Index k, CurvatureScratch& scratch, Tensor* __restrict rim) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const std::uint16_t* count = s.tiles.incoming_count.data() + tile.node;
  const Tiles::Incoming* incoming = s.tiles.incoming.data() + tile.incoming;
  const std::uint16_t* near = s.second_order->rows.near.data() + tile.slot;
  const ThreeTensors* moments = scratch.moments.data();
  const Double4* C = scratch.centroid.data();
  const auto received = [&](Index bonds) {
    Columns sum[3]{};
    for (const Tiles::Incoming* end = incoming + bonds; incoming != end; ++incoming) {
      const Columns* Z = moments[incoming->from].k;
      const Double4 w = C[near[incoming->slot]] - C[incoming->from];
      for (int l = 0; l < 3; ++l) {
        sum[l].c0 += Z[l].c0 * w[l];
        sum[l].c1 += Z[l].c1 * w[l];
        sum[l].c2 += Z[l].c2 * w[l];
      }
    }
    return sum[0] + sum[1] + sum[2];
  };
  const double* volume = s.d.volume.data() + tile.begin;
  Columns* __restrict T = scratch.T.data();
  for (Index a = 0; a < own; ++a) T[a] = T[a] + (1.0 / volume[a]) * received(count[a]);
  for (Index i = 0; i < rim_size; ++i) store(rim[tile.rim + i], received(count[own + i]));
}

}  // namespace

TESSERA_KERNEL void curvature_moment_sweep(const System& s, Index k, const Tensor* T, const Hessian* moment,
                                           CurvatureScratch& scratch, Tensor* T_first, Tensor* rim) {
  double* nodes = scratch.nodes.data();
  const Vec3 *X = s.d.X.data(), *C = s.d.measure->centroid.data();
  const double* inverse_sum = s.second_order->rows.inverse_sum.data();
  for_each_node(
      s, k,
      [&](Index local, Index b) {
        double* node = nodes + moment_node * local;
        for (int i = 0; i < 9; ++i) node[i] = T[b].m[i];
        for (Index i = 0; i < components; ++i) node[9 + i] = inverse_sum[b] * moment[b].h[i];
        put(node + 9 + components, X[b]);
        scratch.centroid[static_cast<std::size_t>(local)] = to_kernel(C[b]);
      },
      [&](Index b) { fetch(T + b), fetch(moment + b), fetch(X + b), fetch(C + b), fetch(inverse_sum + b); });
  Quads rows(s, k);
  const double* volume = s.d.volume.data() + rows.tile.begin;
  for (Index q = 0; q < rows.tile.quads(); ++q, rows.next()) {
    Double4 own[moment_node], g[components]{};
    load_numbers(nodes, moment_node, rows.order, own);
    for (Index i = 0; i < *rows.length; ++i, rows.next_slot()) {
      Double4 b[moment_node], t[3]{};
      load_numbers(nodes, moment_node, rows.near, b);
      unrolled<3>([&](auto j) {
        const Double4 x = b[9 + components + j] - own[9 + components + j];
        unrolled<3>([&](auto m) { t[m] += x * (own[3 * j + m] - b[3 * j + m]); });
      });
      unrolled<derivatives>([&](auto r) {
        const Double4 M = rows.M[r];
        unrolled<3>([&](auto m) { g[3 * r + m] += M * t[m] + b[9 + 3 * r + m]; });
      });
    }
    const CurvatureRows::Constants& constants = *rows.constants;
    unrolled<components>([&](auto m) { g[m] = constants.weight * (g[m] + constants.repeated * own[9 + m]); });
    Double4 total[9];
    const Double4 V{volume[rows.order[0]], volume[rows.order[1]], volume[rows.order[2]], volume[rows.order[3]]};
    unrolled<9>([&](auto m) { total[m] = V * own[m]; });
    const Index lanes = std::min(quad, rows.tile.size() - quad * q);
    unrolled<3>([&](auto l) {
      Double4 Z[9]{};
      unrolled<derivatives>([&](auto r) {
        unrolled<3>([&](auto j) {
          const Double4 S = rows.map[9 * r + 3 * j + l];
          unrolled<3>([&](auto i) { Z[3 * j + i] += S * g[3 * r + i]; });
        });
      });
      unrolled<9>([&](auto m) { total[m] -= constants.offset[l] * Z[m]; });
      const FourVectors c0 = transposed(Lanes3{Z[0], Z[1], Z[2]}), c1 = transposed(Lanes3{Z[3], Z[4], Z[5]}),
                        c2 = transposed(Lanes3{Z[6], Z[7], Z[8]});
      for (Index lane = 0; lane < lanes; ++lane)
        scratch.moments[rows.order[lane]].k[l] = {c0.v[lane], c1.v[lane], c2.v[lane]};
    });
    const FourVectors c0 = transposed(Lanes3{total[0] / V, total[1] / V, total[2] / V}),
                      c1 = transposed(Lanes3{total[3] / V, total[4] / V, total[5] / V}),
                      c2 = transposed(Lanes3{total[6] / V, total[7] / V, total[8] / V});
    for (Index lane = 0; lane < lanes; ++lane) scratch.T[rows.order[lane]] = {c0.v[lane], c1.v[lane], c2.v[lane]};
  }
  return_gradient_moments(s, k, scratch, rim);
  for (Index a = 0; a < rows.tile.size(); ++a)
    store(T_first[rows.tile.begin + a], scratch.T[static_cast<std::size_t>(a)]);
}

namespace {

inline Double4 vector(const Hessian& H, Index r) { return Double4{H.h[3 * r], H.h[3 * r + 1], H.h[3 * r + 2], 0.0}; }

}  // namespace

TESSERA_KERNEL void point_strain_sweep(const Mat3* points, Index begin, Index end, const Hessian* H, ThreeTensors* E) {
  for (Index a = begin; a < end; ++a) {
    Double4 h[derivatives];
    for (Index r = 0; r < derivatives; ++r) h[r] = vector(H[a], r);
    const Mat3& p = points[a];
    for (int q = 0; q < 3; ++q)
      E[a].k[q] = {p(0, q) * h[0] + p(1, q) * h[1] + p(2, q) * h[2], p(0, q) * h[1] + p(1, q) * h[3] + p(2, q) * h[4],
                   p(0, q) * h[2] + p(1, q) * h[4] + p(2, q) * h[5]};
  }
}

TESSERA_KERNEL void point_moment_sweep(const Mat3* points, Index begin, Index end, const ThreeTensors* Z, Hessian* G) {
  for (Index a = begin; a < end; ++a) {
    const Mat3& p = points[a];
    Double4 g[derivatives]{};
    for (int q = 0; q < 3; ++q) {
      const Columns& z = Z[a].k[q];
      g[0] += p(0, q) * z.c0;
      g[1] += p(0, q) * z.c1 + p(1, q) * z.c0;
      g[2] += p(0, q) * z.c2 + p(2, q) * z.c0;
      g[3] += p(1, q) * z.c1;
      g[4] += p(1, q) * z.c2 + p(2, q) * z.c1;
      g[5] += p(2, q) * z.c2;
    }
    for (Index r = 0; r < derivatives; ++r)
      for (int i = 0; i < 3; ++i) G[a].h[3 * r + i] = g[r][i];
  }
}

}  // namespace tessera
