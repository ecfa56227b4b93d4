#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "tessera/mechanics/cell_sweeps.hpp"
#include "tessera/mechanics/cubature.hpp"
#include "tessera/mechanics/tensor_rows.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

// Stresses at the points of the cells of a tile, four cells at once, or eight where registers have 512 bits. How F
// varies in the cells is told by a Source, whose Variation<Lanes> has
//
//     group(system, tile, quad)                the cells that are taken at once from this quad on,
//     find(group)                              the E_q of a group of cells,
//     take(group, volume, moment, stress)      what becomes of the derivatives by E_q; adds to the cells' own stress.

namespace tessera {

/// E_q, q = 1 to 3, of several cells.
template <class Lanes>
struct PointStrains {
  Lanes9Of<Lanes> E[3];
};

/// Consecutive quads of a tile whose cells are taken at once. The last particle fills up what is left.
template <class Lanes>
struct CellGroup {
  static constexpr Index lanes = lanes_in<Lanes>, quads = lanes / quad;

  CellGroup(const System& s, const Tile& tile, Index first_quad)
      : local{}, first(first_quad), count(std::min(lanes, tile.size() - quad * first_quad)) {
    const std::uint16_t* order = s.tiles.order.data() + quad * (tile.quad + first_quad);
    for (Index lane = 0; lane < lanes; ++lane) local[lane] = order[std::min(lane, count - 1)];
  }

  /// Consecutive cells in place of those of quads.
  CellGroup(const Tile& tile, Index first_quad)
      : local{}, first(first_quad), count(std::min(lanes, tile.size() - quad * first_quad)) {
    for (Index lane = 0; lane < lanes; ++lane)
      local[lane] = static_cast<std::uint16_t>(quad * first_quad + std::min(lane, count - 1));
  }

  /// One number of each cell.
  Lanes operator()(const double* values) const {
    Lanes all{};
    for (Index lane = 0; lane < lanes; ++lane) all[lane] = values[local[lane]];
    return all;
  }

  std::uint16_t local[lanes];  // local numbers
  Index first;                 // of the quads
  Index count;                 // lanes that count
};

/// F of a group; `F` begins with the tile.
template <class Lanes>
inline Lanes9Of<Lanes> load_F(const Tensor* F, const CellGroup<Lanes>& group) {
  const double* row[lanes_in<Lanes>];
  for (Index lane = 0; lane < group.lanes; ++lane) row[lane] = F[group.local[lane]].m;
  return lanes_of_rows<Lanes>(row);
}

/// Lanes that repeat a particle keep nothing.
template <class Lanes>
inline LanesHistoryOf<Lanes> history_of_point(const HistorySpan& history, Index first, const CellGroup<Lanes>& group,
                                              int point) {
  LanesHistoryOf<Lanes> all;
  if (history.before == nullptr) return all;
  for (Index lane = 0; lane < group.lanes; ++lane) {
    const Offset at = static_cast<Offset>(first + group.local[lane]) * stress_points_of_a_cell + point;
    const auto l = static_cast<std::size_t>(lane);
    all.before[l] = history.before + at;
    if (history.after != nullptr && lane < group.count) all.after[l] = history.after + at;
  }
  return all;
}

/// What is done with the stresses of a tile beside adding them up.
struct CellTask {
  const System& s;
  Index tile;
  const Tensor* F;
  const HistorySpan& history;
  ViscousMemory* viscous;
  double dt;
  TileScratch& scratch;
  const CellReport& report;
  const Tensor* at_centroids = nullptr;  // F there, where some F_a belong elsewhere; null: F

  const Tensor* gradients_at_centroids() const { return at_centroids != nullptr ? at_centroids : F; }
};

/// Adds the elastic and viscous stress of a group's cells to the scratch, and what they report.
template <class Law, class Lanes>
inline void keep_stress(const CellTask& task, const CellGroup<Lanes>& group, const CubatureStress<Lanes>& c,
                        const Lanes9Of<Lanes>& total, StressSums& sums) {
  const System& s = task.s;
  const Index begin = tile_of(s, task.tile).begin;
  const bool apart = !task.scratch.P.empty();
  Columns* __restrict T = apart ? task.scratch.P.data() : task.scratch.T.data();
  const ColumnsOf<Lanes> stress(total);
  for (Index lane = 0; lane < group.count; ++lane) {
    const Index local = group.local[lane], a = begin + local;
    const double volume = s.d.volume[static_cast<std::size_t>(a)];
    sums.internal += volume * c.energy[lane];
    if constexpr (HasHistory<Law>) sums.dissipated += volume * c.dissipated[lane];
    Columns P = stress.t[lane];
    if (task.viscous != nullptr && task.dt > 0.0)
      sums.dissipated += add_viscous_stress(s, a, task.F[a], *task.viscous, task.dt, P);
    T[local] = apart ? P : T[local] + P;
    if (task.report.smallest_J != nullptr) task.report.smallest_J[a] = c.smallest_J[lane];
    if (task.report.energy != nullptr) task.report.energy[a] = c.energy[lane];
  }
  if (task.report.mean == nullptr) return;
  const ColumnsOf<Lanes> mean(c.mean);
  for (Index lane = 0; lane < group.count; ++lane)
    task.report.mean[begin + group.local[lane]] = to_tensor(mean.t[lane]);
}

/// The stresses at the points of a group; sources that know more than F and E have their own.
template <class Source, class Law, class Lanes>
inline CubatureStress<Lanes> point_stresses(const Source&, const CellTask& task, const Law& law,
                                            const CellGroup<Lanes>& group, const Lanes9Of<Lanes>& F,
                                            const Lanes9Of<Lanes> (&E)[3]) {
  const Index begin = tile_of(task.s, task.tile).begin;
  return cubature_stress(law, F, E, [&](int point) { return history_of_point(task.history, begin, group, point); });
}

template <class Lanes, class Law, class Source>
inline StressSums cells_of(const CellTask& task, const Law& law, const Source& source) {
  const Tile& tile = tile_of(task.s, task.tile);
  const double* volume = task.s.d.volume.data() + tile.begin;
  typename Source::template Variation<Lanes> variation(source);
  StressSums sums;
  Lanes smallest_J{}, not_finite{};
  smallest_J += std::numeric_limits<double>::infinity();
  for (Index q = 0; q < tile.quads(); q += CellGroup<Lanes>::quads) {
    const CellGroup<Lanes> group = Source::template Variation<Lanes>::group(task.s, tile, q);
    const PointStrains<Lanes> strains = variation.find(group);
    const Lanes9Of<Lanes> F = load_F(task.gradients_at_centroids() + tile.begin, group);
    const CubatureStress<Lanes> c = point_stresses(source, task, law, group, F, strains.E);
    smallest_J = smallest_J < c.smallest_J ? smallest_J : c.smallest_J;
    not_finite += c.not_finite;
    Lanes9Of<Lanes> total = c.mean;
    variation.take(group, group(volume), c.moment, total);
    keep_stress<Law>(task, group, c, total, sums);
  }
  double no_number = 0.0;
  for (Index lane = 0; lane < lanes_in<Lanes>; ++lane) {
    sums.smallest_J = std::min(sums.smallest_J, smallest_J[lane]);
    no_number += not_finite[lane];
  }
  sums.finite = std::isfinite(no_number);
  return sums;
}

// One clone of each law for every instruction set, and for laws that answer in lanes one with registers of 512 bits.
#ifdef TESSERA_WIDE_KERNEL
#define TESSERA_WIDE_CELL_KERNEL(Law, Source)                                                                 \
  TESSERA_WIDE_KERNEL StressSums cells_of_eight(const CellTask& task, const Law& law, const Source& source) { \
    return cells_of<Double8>(task, law, source);                                                              \
  }
#else
#define TESSERA_WIDE_CELL_KERNEL(Law, Source)
#endif
#define TESSERA_CELL_KERNEL(Law, Source)                                                                \
  TESSERA_KERNEL StressSums cells_of_four(const CellTask& task, const Law& law, const Source& source) { \
    return cells_of<Double4>(task, law, source);                                                        \
  }
#define TESSERA_CELL_KERNELS(Source)                \
  TESSERA_FOR_EACH_LAW(TESSERA_CELL_KERNEL, Source) \
  TESSERA_FOR_EACH_LAW_IN_LANES(TESSERA_WIDE_CELL_KERNEL, Source)

// Returns what the kernel for this law and these registers says.
#ifdef TESSERA_WIDE_KERNEL
#define TESSERA_RUN_CELL_KERNEL(task, law, source, registers)                              \
  if constexpr (InLanes<std::decay_t<decltype(law)>>)                                      \
    if ((registers) == Registers::eight_numbers) return cells_of_eight(task, law, source); \
  return cells_of_four(task, law, source)
#else
#define TESSERA_RUN_CELL_KERNEL(task, law, source, registers) return cells_of_four(task, law, source)
#endif

}  // namespace tessera
