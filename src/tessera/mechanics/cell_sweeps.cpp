#include "tessera/mechanics/cell_sweeps.hpp"

#include <cmath>

#include "tessera/mechanics/cubature.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

namespace {

/// Sums over the neighbours of four particles.
struct GradientSums {
  Lanes9 G[3];      // (1/2) sum (F_b - F_a) C_ab,k / r^2, k = 1 to 3
  Lanes3 arrivals;  // sum C_ab / r^2
};

inline Lanes3 load_centroids(const Double4* C, const std::uint16_t* local) {
  return transposed(C[local[0]], C[local[1]], C[local[2]], C[local[3]]);
}

/// F/2 of four nodes.
inline Lanes9 load_half_F(const TileNode* nodes, const std::uint16_t* local) {
  const double *n0 = nodes[local[0]].value, *n1 = nodes[local[1]].value, *n2 = nodes[local[2]].value,
               *n3 = nodes[local[3]].value;
  const auto pairs = [&](Index k) { return load_pairs(n0 + k, n1 + k, n2 + k, n3 + k); };
  const TwoLanes p0 = pairs(0), p2 = pairs(2), p4 = pairs(4), p6 = pairs(6), p8 = pairs(8);
  return {p0.first, p2.second, p6.first, p0.second, p4.first, p6.second, p2.first, p4.second, p8.first};
}

/// Adds a neighbour of each of four particles and returns C_ab / r^2, zero where there is no common face.
inline Lanes3 add_neighbour(const Lanes9& F_a, const Lanes9& F_b, const Lanes3& C_ab, const Double4& area_over_length,
                            GradientSums& sums) {
  const Double4 square = C_ab.x * C_ab.x + C_ab.y * C_ab.y + C_ab.z * C_ab.z;
  const Double4 zero{};
  const Lanes3 w = (area_over_length > zero ? 1.0 / square : zero) * C_ab;
  Lanes9 difference = F_b;
  add(difference, zero - 1.0, F_a);
  add(sums.G[0], w.x, difference);
  add(sums.G[1], w.y, difference);
  add(sums.G[2], w.z, difference);
  sums.arrivals = sums.arrivals + w;
  return w;
}

/// A_a of four particles.
struct FourMatrices {
  Double4 m[3][3];
};

inline FourMatrices load_matrices(const Mat3* A, const std::uint16_t* local) {
  FourMatrices four;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      four.m[i][j] = Double4{A[local[0]](i, j), A[local[1]](i, j), A[local[2]](i, j), A[local[3]](i, j)};
  return four;
}

/// The rows of four particles of a tile.
struct Quad {
  const std::uint16_t* order;  // local numbers
  Index length;
  Index lanes;  // that count
};

/// Writes the three tensors of four cells, times their volumes.
inline void keep(const Quad& rows, const Double4& volume, const Lanes9 (&t)[3], ThreeTensors* to) {
  for (int k = 0; k < 3; ++k) {
    Lanes9 scaled;
    add(scaled, volume, t[k]);
    const FourColumns four = columns_of(scaled);
    for (Index lane = 0; lane < rows.lanes; ++lane) to[rows.order[lane]].k[k] = four.t[lane];
  }
}

inline void load_centroids_of_tile(const System& s, Index k, Double4* __restrict local) {
  const Tile& tile = tile_of(s, k);
  const Vec3* C = s.d.measure->centroid.data();
  for (Index a = tile.begin; a < tile.end; ++a) local[a - tile.begin] = to_kernel(C[a]);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  for (Index i = 0; i < rim_size; ++i) {
    fetch(C + rim[std::min(i + lookahead, rim_size - 1)]);
    local[own + i] = to_kernel(C[rim[i]]);
  }
}

/// The variation of F in four cells by the differences to their neighbours.
class NeighbourVariation {
 public:
  NeighbourVariation(const System& s, Index k, TileScratch& scratch)
      : nodes_(scratch.nodes.data()),
        C_(scratch.centroid.data()),
        to_points_(s.gradients->to_points.data() + tile_of(s, k).begin),
        neighbour_(s.tiles.neighbour.data() + tile_of(s, k).slot),
        area_over_length_(s.tiles.area_over_length.data() + tile_of(s, k).slot),
        weights_(scratch.gradient_weights.data()),
        moments_(scratch.moments.data()) {
    load_centroids_of_tile(s, k, scratch.centroid.data());
  }

  inline void find(const Quad& rows, Lanes9 (&E)[3]) {
    const Lanes9 F_a = load_half_F(nodes_, rows.order);
    const Lanes3 C_a = load_centroids(C_, rows.order);
    GradientSums sums;
    for (Index i = 0; i < rows.length; ++i, neighbour_ += quad, area_over_length_ += quad, weights_ += 3) {
      const Double4 A_L{area_over_length_[0], area_over_length_[1], area_over_length_[2], area_over_length_[3]};
      const Lanes3 w =
          add_neighbour(F_a, load_half_F(nodes_, neighbour_), load_centroids(C_, neighbour_) - C_a, A_L, sums);
      weights_[0] = w.x, weights_[1] = w.y, weights_[2] = w.z;
    }
    A_ = load_matrices(to_points_, rows.order);
    arrivals_ = sums.arrivals;
    const Double4 two = Double4{} + 2.0;
    for (int q = 0; q < 3; ++q)
      for (int k = 0; k < 3; ++k) add(E[q], two * A_.m[k][q], sums.G[k]);
  }

  /// Keeps V dU/dG and adds what it does to F_a itself to the stress.
  inline void take(const Quad& rows, const Double4& volume, const Lanes9 (&moment)[3], Lanes9& stress) {
    Lanes9 Z[3];
    for (int k = 0; k < 3; ++k)
      for (int q = 0; q < 3; ++q) add(Z[k], A_.m[k][q], moment[q]);
    const Double4 zero{};
    add(stress, zero - arrivals_.x, Z[0]);
    add(stress, zero - arrivals_.y, Z[1]);
    add(stress, zero - arrivals_.z, Z[2]);
    keep(rows, volume, Z, moments_);
  }

 private:
  const TileNode* nodes_;
  const Double4* C_;
  const Mat3* to_points_;
  const std::uint16_t* neighbour_;
  decltype(Tiles::area_over_length)::const_pointer area_over_length_;
  Double4* weights_;
  ThreeTensors* moments_;
  FourMatrices A_;
  Lanes3 arrivals_;
};

/// A variation that is known.
class KnownVariation {
 public:
  KnownVariation(const ThreeTensors* E, ThreeTensors* Z) : E_(E), Z_(Z) {}

  inline void find(const Quad& rows, Lanes9 (&E)[3]) {
    for (int q = 0; q < 3; ++q)
      E[q] = to_lanes(E_[rows.order[0]].k[q], E_[rows.order[1]].k[q], E_[rows.order[2]].k[q], E_[rows.order[3]].k[q]);
  }
  inline void take(const Quad& rows, const Double4& volume, const Lanes9 (&moment)[3], Lanes9&) {
    keep(rows, volume, moment, Z_);
  }

 private:
  const ThreeTensors* E_;
  ThreeTensors* Z_;
};

/// Lanes that repeat a particle keep nothing.
inline LanesHistory history_of_point(const HistorySpan& history, Index first, const Quad& rows, int point) {
  if (history.before == nullptr) return {};
  std::array<Offset, 4> points{};
  for (std::size_t lane = 0; lane < points.size(); ++lane)
    points[lane] = static_cast<Offset>(first + rows.order[lane]) * stress_points_of_a_cell + point;
  LanesHistory four = history.lanes(points);
  for (Index lane = rows.lanes; lane < quad; ++lane) four.after[static_cast<std::size_t>(lane)] = nullptr;
  return four;
}

template <class Law, class Variation>
inline StressSums cells_of(const System& s, Index k, const Law& law, const Tensor* F, Variation& variation,
                           const HistorySpan& history, ViscousMemory* viscous, double dt, TileScratch& scratch,
                           const CellReport& report) {
  const Tile& tile = tile_of(s, k);
  Columns* __restrict T = scratch.P.empty() ? scratch.T.data() : scratch.P.data();
  const std::uint16_t* order = s.tiles.order.data() + quad * tile.quad;
  const std::uint16_t* length = s.tiles.length.data() + tile.quad;
  const double* volume = s.d.volume.data() + tile.begin;
  const Tensor* F_own = F + tile.begin;
  StressSums sums;
  Double4 smallest_J{}, not_finite{};
  smallest_J += std::numeric_limits<double>::infinity();
  for (Index q = 0; q < tile.quads(); ++q, order += quad) {
    const Quad rows{order, length[q], std::min(quad, tile.size() - quad * q)};
    Lanes9 E[3];
    variation.find(rows, E);
    const CubatureStress c =
        cubature_stress(law, to_lanes(F_own[order[0]], F_own[order[1]], F_own[order[2]], F_own[order[3]]), E,
                        [&](int point) { return history_of_point(history, tile.begin, rows, point); });
    smallest_J = smallest_J < c.smallest_J ? smallest_J : c.smallest_J;
    not_finite += c.not_finite;
    Lanes9 total = c.mean;
    const Double4 V{volume[order[0]], volume[order[1]], volume[order[2]], volume[order[3]]};
    variation.take(rows, V, c.moment, total);
    const FourColumns stress = columns_of(total);
    for (Index lane = 0; lane < rows.lanes; ++lane) {
      const Index local = order[lane], a = tile.begin + local;
      sums.internal += volume[local] * c.energy[lane];
      if constexpr (HasHistory<Law>) sums.dissipated += volume[local] * c.dissipated[lane];
      Columns P = stress.t[lane];
      if (viscous != nullptr && dt > 0.0) sums.dissipated += add_viscous_stress(s, a, F[a], *viscous, dt, P);
      T[local] = scratch.P.empty() ? T[local] + P : P;
      if (report.smallest_J != nullptr) report.smallest_J[a] = c.smallest_J[lane];
      if (report.energy != nullptr) report.energy[a] = c.energy[lane];
    }
    if (report.mean == nullptr) continue;
    const FourColumns mean = columns_of(c.mean);
    for (Index lane = 0; lane < rows.lanes; ++lane) report.mean[tile.begin + order[lane]] = to_tensor(mean.t[lane]);
  }
  sums.smallest_J = std::min(std::min(smallest_J[0], smallest_J[1]), std::min(smallest_J[2], smallest_J[3]));
  sums.finite = std::isfinite(sum(not_finite));
  return sums;
}

// One clone of each law for every instruction set.
#define TESSERA_CELL_KERNEL(Law, Variation)                                                                      \
  TESSERA_KERNEL StressSums cell_kernel(const System& s, Index k, const Law& law, const Tensor* F,               \
                                        Variation variation, const HistorySpan& history, ViscousMemory* viscous, \
                                        double dt, TileScratch& scratch, const CellReport& report) {             \
    return cells_of(s, k, law, F, variation, history, viscous, dt, scratch, report);                             \
  }
#define TESSERA_CELL_KERNELS(Law)              \
  TESSERA_CELL_KERNEL(Law, NeighbourVariation) \
  TESSERA_CELL_KERNEL(Law, KnownVariation)
TESSERA_CELL_KERNELS(NeoHookean)
TESSERA_CELL_KERNELS(SaintVenantKirchhoff)
TESSERA_CELL_KERNELS(MooneyRivlin)
TESSERA_CELL_KERNELS(Ogden)
TESSERA_CELL_KERNELS(J2Plasticity)
#undef TESSERA_CELL_KERNELS
#undef TESSERA_CELL_KERNEL

/// What the moments of the tile's own stresses do to F_b: sum_a Z_a C_ab / r^2 of the bonds that lead to b, [J].
TESSERA_KERNEL void return_moments(const System& s, Index k, const TileScratch& scratch, const CellStress& stress) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const std::uint16_t* count = s.tiles.incoming_count.data() + tile.node;
  const Tiles::Incoming* incoming = s.tiles.incoming.data() + tile.incoming;
  const ThreeTensors* moments = scratch.moments.data();
  const double* weights = reinterpret_cast<const double*>(scratch.gradient_weights.data());
  const auto received = [&](Index bonds) {
    Columns sum[3]{};
    for (const Tiles::Incoming* end = incoming + bonds; incoming != end; ++incoming) {
      const Columns* Z = moments[incoming->from].k;
      const double* w = weights + 12 * (incoming->slot / 4) + incoming->slot % 4;
      for (int i = 0; i < 3; ++i) {
        sum[i].c0 += Z[i].c0 * w[4 * i];
        sum[i].c1 += Z[i].c1 * w[4 * i];
        sum[i].c2 += Z[i].c2 * w[4 * i];
      }
    }
    return sum[0] + sum[1] + sum[2];
  };
  const double* volume = s.d.volume.data() + tile.begin;
  const Columns* T = scratch.P.empty() ? scratch.T.data() : scratch.P.data();
  Tensor* __restrict to = stress.own + tile.begin, * __restrict rim = stress.rim + tile.rim;
  for (Index a = 0; a < own; ++a) store(to[a], T[a] + (1.0 / volume[a]) * received(count[a]));
  for (Index i = 0; i < rim_size; ++i) store(rim[i], received(count[own + i]));
}

/// The gradient vectors of a tile, fetched a few lines with each of its particles.
class LinesOfTile {
 public:
  LinesOfTile(const System& s, Index k)
      : first_(reinterpret_cast<const char*>(s.tiles.B.data() + tile_of(s, k).slot)),
        lines_((s.tiles.end_of(k).slot - tile_of(s, k).slot) * static_cast<Offset>(sizeof(Vec3)) / line /
                   std::max<Index>(tile_of(s, k).size(), 1) +
               1) {}

  void fetch(Index particle) const {
    const char* B = first_ + particle * lines_ * line;
    for (Offset i = 0; i < lines_; ++i) __builtin_prefetch(B + line * i);
  }

 private:
  static constexpr Offset line = 64;
  const char* first_;
  Offset lines_;  // for each particle
};

}  // namespace

StressSums cell_stress_sweep(const System& s, Index k, const Tensor* F, const HistorySpan& history,
                             ViscousMemory* viscous, double dt, TileScratch& scratch, const CellStress& stress,
                             const CellReport& report) {
  const Material& m = s.materials[static_cast<std::size_t>(tile_of(s, k).material)];
  const NeighbourVariation variation(s, k, scratch);
  const StressSums sums = visit_law(m.law, history.flow, [&](const auto& law) {
    return cell_kernel(s, k, law, F, variation, history, viscous, dt, scratch, report);
  });
  return_moments(s, k, scratch, stress);
  return sums;
}

StressSums varied_stress_sweep(const System& s, Index k, const Tensor* F, const ThreeTensors* E,
                               const HistorySpan& history, ViscousMemory* viscous, double dt, TileScratch& scratch,
                               ThreeTensors* Z, const CellReport& report) {
  const Tile& tile = tile_of(s, k);
  const Material& m = s.materials[static_cast<std::size_t>(tile.material)];
  const KnownVariation variation(E + tile.begin, Z + tile.begin);
  return visit_law(m.law, history.flow, [&](const auto& law) {
    return cell_kernel(s, k, law, F, variation, history, viscous, dt, scratch, report);
  });
}

void load_tile(const System& s, Index k, const Double4* x, const Tensor* F, TileScratch& scratch) {
  fill_nodes(s, k, x, F, scratch.nodes.data());
}

TESSERA_KERNEL void complete_stresses(const System& s, Index k, const Tensor* own, const Tensor* rims,
                                      Columns* __restrict T) {
  const Tile& tile = tile_of(s, k);
  const Index size = tile.size();
  const Offset* offset = s.tiles.rim_offset.data() + tile.begin;
  const Index* place = s.tiles.rim_place.data();
  const double* volume = s.d.volume.data() + tile.begin;
  const Offset last = s.tiles.rim_offset.back() - 1;
  const LinesOfTile B(s, k);
  own += tile.begin;
  for (Index a = 0; a < size; ++a) {
    B.fetch(a);
    Columns sum{};
    for (Offset i = offset[a]; i < offset[a + 1]; ++i) {
      fetch(rims + place[std::min(i + 2 * lookahead, last)]);
      sum = sum + to_kernel(rims[place[i]]);
    }
    T[a] = to_kernel(own[a]) + (1.0 / volume[a]) * sum;
  }
}

}  // namespace tessera
