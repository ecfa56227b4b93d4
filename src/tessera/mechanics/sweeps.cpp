#include "tessera/mechanics/sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/laws/law_lanes.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

StressSums& StressSums::operator+=(const StressSums& o) {
  internal += o.internal;
  contact += o.contact;
  dissipated += o.dissipated;
  smallest_J = std::min(smallest_J, o.smallest_J);
  finite = finite && o.finite;
  return *this;
}

TileScratch::TileScratch(const System& s)
    : x(static_cast<std::size_t>(s.tiles.most_nodes)),
      nodes(static_cast<std::size_t>(s.tiles.most_nodes)),
      T(static_cast<std::size_t>(s.tiles.most_particles)) {
  if (!s.gradients) return;
  centroid.resize(nodes.size());
  moments.resize(T.size());
  Offset most_slots = 0;
  for (Index k = 0; k < s.tiles.size(); ++k)
    most_slots = std::max(most_slots, s.tiles.end_of(k).slot - tile_of(s, k).slot);
  gradient_weights.resize(static_cast<std::size_t>(most_slots));
}

TESSERA_KERNEL void strain_sweep(const System& s, Index k, const Double4* x, Tensor* F, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  Double4* __restrict x_local = scratch.x.data();
  for (Index a = 0; a < own; ++a) {
    fetch_ahead<2048>(x + tile.begin + a);
    x_local[a] = x[tile.begin + a];
  }
  for (Index i = 0; i < rim_size; ++i) {
    fetch(x + rim[std::min(i + lookahead, rim_size - 1)]);
    x_local[own + i] = x[rim[i]];
  }
  const Vec3* B = s.tiles.B.data() + tile.slot;
  const std::uint16_t* neighbour = s.tiles.neighbour.data() + tile.slot;
  const std::uint16_t* order = s.tiles.order.data() + quad * tile.quad;
  const std::uint16_t* length = s.tiles.length.data() + tile.quad;
  const double* volume = s.d.volume.data() + tile.begin;
  Tensor* __restrict F_own = F + tile.begin;
  for (Index q = 0; q < tile.quads(); ++q, order += quad) {
    const auto x_of = [&](Index lane) { return x_local[order[lane]]; };
    const Double4 x_0 = x_of(0), x_1 = x_of(1), x_2 = x_of(2), x_3 = x_of(3);
    Columns VF_0{}, VF_1{}, VF_2{}, VF_3{};  // by name: the compiler would keep an array in memory
    for (Index i = 0; i < length[q]; ++i, neighbour += quad, B += quad) {
      fetch_ahead<1536>(B);
      fetch_ahead<1600>(B);
      fetch_ahead<512>(neighbour);
      add_outer(VF_0, x_local[neighbour[0]] - x_0, B[0]);
      add_outer(VF_1, x_local[neighbour[1]] - x_1, B[1]);
      add_outer(VF_2, x_local[neighbour[2]] - x_2, B[2]);
      add_outer(VF_3, x_local[neighbour[3]] - x_3, B[3]);
    }
    fetch_ahead<1024>(order);
    fetch_ahead<1024>(volume + quad * q);
    for (Index line = 0; line < 5; ++line)
      fetch_to_write<6912>(reinterpret_cast<const char*>(F_own + quad * q) + 64 * line);
    const auto keep = [&](Index lane, const Columns& VF) {
      store(F_own[order[lane]], (1.0 / volume[order[lane]]) * VF);
    };
    // Backwards: lanes that fill up the last quad repeat its last particle and come before it.
    keep(3, VF_3), keep(2, VF_2), keep(1, VF_1), keep(0, VF_0);
  }
}

namespace {

/// Where the stresses of a tile's own particles go.
struct StressTarget {
  explicit StressTarget(TileScratch& scratch)
      : T(scratch.T.data()), P(scratch.P.empty() ? nullptr : scratch.P.data()) {}

  /// Adds an elastic stress to T, or puts it where it goes another way.
  void take(Index local, const Columns& stress) const {
    if (P == nullptr)
      T[local] = T[local] + stress;
    else
      P[local] = stress;
  }
  Columns& at(Index local) const { return P == nullptr ? T[local] : P[local]; }

  Columns* __restrict T;
  Columns* __restrict P;
};

/// Adds the viscous stresses of a tile's own particles, if there are any; returns their work [J].
double add_viscous_stresses(const System& s, const Tile& tile, const Tensor* F, ViscousMemory* viscous, double dt,
                            const StressTarget& target) {
  double work = 0.0;
  if (viscous == nullptr || dt <= 0.0) return work;
  for (Index a = tile.begin; a < tile.end; ++a)
    work += add_viscous_stress(s, a, F[a], *viscous, dt, target.at(a - tile.begin));
  return work;
}

/// Histories of the particles from `first` on; lanes beyond `count` repeat the last one and keep nothing.
template <class Lanes>
inline LanesHistoryOf<Lanes> histories(const HistorySpan& history, Index first, Index count) {
  LanesHistoryOf<Lanes> all;
  for (Index lane = 0; lane < lanes_in<Lanes>; ++lane) {
    const auto l = static_cast<std::size_t>(lane);
    if (history.before != nullptr) all.before[l] = history.before + first + std::min(lane, count - 1);
    if (history.after != nullptr && lane < count) all.after[l] = history.after + first + lane;
  }
  return all;
}

template <class Lanes, class Law>
inline StressSums elastic_stresses(const System& s, const Tile& tile, const Law& law, const Tensor* F,
                                   const HistorySpan& history, const StressTarget& target) {
  constexpr Index width = lanes_in<Lanes>;
  const double* volume = s.d.volume.data();
  StressSums sums;
  Lanes smallest_J{}, not_finite{};
  smallest_J += std::numeric_limits<double>::infinity();
  for (Index first = tile.begin; first < tile.end; first += width) {
    const Index count = std::min(width, tile.end - first);
    const double* row[width];
    for (Index lane = 0; lane < width; ++lane) row[lane] = F[first + std::min(lane, count - 1)].m;
    const LanesResponseOf<Lanes> answer =
        response(law, lanes_of_rows<Lanes>(row), histories<Lanes>(history, first, count));
    smallest_J = smallest_J < answer.J ? smallest_J : answer.J;
    not_finite += answer.J - answer.J;
    const ColumnsOf<Lanes> P(answer.stress);
    for (Index lane = 0; lane < count; ++lane) {
      const Index a = first + lane;
      sums.internal += volume[a] * answer.energy[lane];
      if constexpr (HasHistory<Law>) sums.dissipated += volume[a] * answer.dissipated[lane];
      target.take(a - tile.begin, P.t[lane]);
    }
  }
  double no_number = 0.0;
  for (Index lane = 0; lane < width; ++lane) {
    sums.smallest_J = std::min(sums.smallest_J, smallest_J[lane]);
    no_number += not_finite[lane];
  }
  sums.finite = std::isfinite(no_number);
  return sums;
}

// One clone of each law for every instruction set, and for laws that answer in lanes one with registers of 512 bits.
#define TESSERA_STRESS_KERNEL(Law)                                                                               \
  TESSERA_KERNEL StressSums stresses_of_four(const System& s, const Tile& tile, const Law& law, const Tensor* F, \
                                             const HistorySpan& history, const StressTarget& target) {           \
    return elastic_stresses<Double4>(s, tile, law, F, history, target);                                          \
  }
TESSERA_FOR_EACH_LAW(TESSERA_STRESS_KERNEL)
#undef TESSERA_STRESS_KERNEL
#ifdef TESSERA_WIDE_KERNEL
#define TESSERA_STRESS_KERNEL(Law)                                                                                     \
  TESSERA_WIDE_KERNEL StressSums stresses_of_eight(const System& s, const Tile& tile, const Law& law, const Tensor* F, \
                                                   const HistorySpan& history, const StressTarget& target) {           \
    return elastic_stresses<Double8>(s, tile, law, F, history, target);                                                \
  }
TESSERA_FOR_EACH_LAW_IN_LANES(TESSERA_STRESS_KERNEL)
#undef TESSERA_STRESS_KERNEL
#endif

template <class Law>
StressSums run_stress_kernel(const System& s, const Tile& tile, const Law& law, const Tensor* F,
                             const HistorySpan& history, const StressTarget& target) {
#ifdef TESSERA_WIDE_KERNEL
  if constexpr (InLanes<Law>)
    if (widest_registers() == Registers::eight_numbers) return stresses_of_eight(s, tile, law, F, history, target);
#endif
  return stresses_of_four(s, tile, law, F, history, target);
}

}  // namespace

StressSums stress_sweep(const System& s, Index k, const Tensor* F, const HistorySpan& history, ViscousMemory* viscous,
                        double dt, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  const StressTarget target(scratch);
  StressSums sums = visit_law(s.materials[static_cast<std::size_t>(tile.material)].law, history.flow,
                              [&](const auto& law) { return run_stress_kernel(s, tile, law, F, history, target); });
  sums.dissipated += add_viscous_stresses(s, tile, F, viscous, dt, target);
  return sums;
}

StressSums known_stress_sweep(const System& s, Index k, const Tensor* F, const Tensor* P, ViscousMemory* viscous,
                              double dt, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  const StressTarget target(scratch);
  for (Index a = tile.begin; a < tile.end; ++a) target.take(a - tile.begin, to_kernel(P[a]));
  StressSums sums;
  sums.dissipated = add_viscous_stresses(s, tile, F, viscous, dt, target);
  return sums;
}

TESSERA_KERNEL void force_sweep(const System& s, Index k, const Columns* T, const Vec3* B, const Vec3* B_aa, Double4* f,
                                Double4* rim_f) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const std::uint16_t* count = s.tiles.incoming_count.data() + tile.node;
  const Tiles::Incoming* incoming = s.tiles.incoming.data() + tile.incoming;
  const Vec3* B_tile = B + tile.slot;
  const auto received = [&](Index bonds) {
    Double4 sum_0{}, sum_1{}, sum_2{};
    fetch_ahead<1024>(incoming);
    for (const Tiles::Incoming* end = incoming + bonds; incoming != end; ++incoming) {
      const Columns& T_a = T[incoming->from];
      const Vec3& B_ab = B_tile[incoming->slot];
      sum_0 += T_a.c0 * B_ab.x;
      sum_1 += T_a.c1 * B_ab.y;
      sum_2 += T_a.c2 * B_ab.z;
    }
    return sum_0 + sum_1 + sum_2;
  };
  Double4* __restrict f_own = f + tile.begin;
  for (Index a = 0; a < own; ++a) {
    fetch_ahead<1024>(count + a);
    fetch_ahead<1536>(B_aa + tile.begin + a);
    f_own[a] -= received(count[a]) + apply(T[a], B_aa[tile.begin + a]);
  }
  for (Index i = 0; i < rim_size; ++i) {
    fetch_to_write<2048>(rim_f + tile.rim + i);
    rim_f[tile.rim + i] = -received(count[own + i]);
  }
}

TESSERA_KERNEL void collect_rims(const Tiles& tiles, const Double4* rim_f, const Double4* f, Double4* total,
                                 Index begin, Index end) {
  const Index* place = tiles.rim_place.data();
  const Offset last = static_cast<Offset>(tiles.rim_place.size()) - 1;
  for (Index a = begin; a < end; ++a) {
    const auto k = static_cast<std::size_t>(a);
    fetch_ahead<2048>(f + (a - begin));
    fetch_ahead<1024>(tiles.rim_offset.data() + k);
    Double4 force = f[a - begin];
    for (Offset i = tiles.rim_offset[k]; i < tiles.rim_offset[k + 1]; ++i) {
      fetch(rim_f + place[std::min(i + 2 * lookahead, last)]);
      force += rim_f[place[i]];
    }
    total[a - begin] = force;
  }
}

}  // namespace tessera
