#include "tessera/mechanics/averaged_cells.hpp"

#include "tessera/mechanics/isochoric_cubature.hpp"
#include "tessera/mechanics/neighbour_variation.hpp"

namespace tessera {

namespace {

/// Differences of F to the neighbours, and means over them.
struct AveragedNeighbours : Neighbours {
  CellMeans means;  // begin with the tile
};

template <class Law, class Lanes>
inline IsochoricStress<Lanes> isochoric_stress_of_group(const AveragedNeighbours& source, const CellTask& task,
                                                        const Law& law, const CellGroup<Lanes>& group,
                                                        const Lanes9Of<Lanes>& F, const Lanes9Of<Lanes> (&E)[3]) {
  const Index begin = tile_of(task.s, task.tile).begin;
  return isochoric_stress(law, F, E, group(source.means.J),
                          [&](int point) { return history_of_point(task.history, begin, group, point); });
}

template <class Law, class Lanes>
inline CubatureStress<Lanes> point_stresses(const AveragedNeighbours& source, const CellTask& task, const Law& law,
                                            const CellGroup<Lanes>& group, const Lanes9Of<Lanes>& F,
                                            const Lanes9Of<Lanes> (&E)[3]) {
  IsochoricStress<Lanes> c = isochoric_stress_of_group(source, task, law, group, F, E);
  add_mean_pressure(group(source.means.p), F, E, c.sums);
  return c.sums;
}

/// Puts one number of each cell of a tile, found(group, F, E), to its place.
template <class Lanes, class Found>
inline void find_numbers(const CellTask& task, const Neighbours& source, double* numbers, const Found& found) {
  const Tile& tile = tile_of(task.s, task.tile);
  Neighbours::Variation<Lanes> variation(source);
  for (Index q = 0; q < tile.quads(); q += CellGroup<Lanes>::quads) {
    const CellGroup<Lanes> group(task.s, tile, q);
    const PointStrains<Lanes> strains = variation.find(group);
    const Lanes all = found(group, load_F(task.F + tile.begin, group), strains.E);
    for (Index lane = 0; lane < group.count; ++lane) numbers[tile.begin + group.local[lane]] = all[lane];
  }
}

template <class Lanes>
inline void volumes_of(const CellTask& task, const Neighbours& source, double* J) {
  find_numbers<Lanes>(
      task, source, J,
      [](const CellGroup<Lanes>&, const Lanes9Of<Lanes>& F, const Lanes9Of<Lanes>(&E)[3]) { return mean_J(F, E); });
}

template <class Lanes, class Law>
inline void pressures_of(const CellTask& task, const Law& law, const AveragedNeighbours& source, double* p) {
  find_numbers<Lanes>(task, source, p,
                      [&](const CellGroup<Lanes>& group, const Lanes9Of<Lanes>& F, const Lanes9Of<Lanes>(&E)[3]) {
                        return isochoric_stress_of_group(source, task, law, group, F, E).p;
                      });
}

TESSERA_CELL_KERNELS(AveragedNeighbours)

TESSERA_KERNEL void volumes_of_four(const CellTask& task, const Neighbours& source, double* J) {
  volumes_of<Double4>(task, source, J);
}

// One clone of each law for every instruction set, as for stresses.
#define TESSERA_PRESSURE_KERNEL(Law)                                                                            \
  TESSERA_KERNEL void pressures_of_four(const CellTask& task, const Law& law, const AveragedNeighbours& source, \
                                        double* p) {                                                            \
    pressures_of<Double4>(task, law, source, p);                                                                \
  }
TESSERA_FOR_EACH_LAW(TESSERA_PRESSURE_KERNEL)
#undef TESSERA_PRESSURE_KERNEL

#ifdef TESSERA_WIDE_KERNEL
TESSERA_WIDE_KERNEL void volumes_of_eight(const CellTask& task, const Neighbours& source, double* J) {
  volumes_of<Double8>(task, source, J);
}
#define TESSERA_WIDE_PRESSURE_KERNEL(Law)                                                                             \
  TESSERA_WIDE_KERNEL void pressures_of_eight(const CellTask& task, const Law& law, const AveragedNeighbours& source, \
                                              double* p) {                                                            \
    pressures_of<Double8>(task, law, source, p);                                                                      \
  }
TESSERA_FOR_EACH_LAW_IN_LANES(TESSERA_WIDE_PRESSURE_KERNEL)
#undef TESSERA_WIDE_PRESSURE_KERNEL
#endif

const Material& material_of(const System& s, Index tile) {
  return s.materials[static_cast<std::size_t>(tile_of(s, tile).material)];
}

}  // namespace

void volume_sweep(const System& s, Index k, const Tensor* F, TileScratch& scratch, double* J) {
  const CellTask task{s, k, F, {}, nullptr, 0.0, scratch, {}};
  const Neighbours source{s, k, scratch};
#ifdef TESSERA_WIDE_KERNEL
  if (widest_registers() == Registers::eight_numbers) {
    volumes_of_eight(task, source, J);
    return;
  }
#endif
  volumes_of_four(task, source, J);
}

void pressure_sweep(const System& s, Index k, const Tensor* F, const HistorySpan& history, TileScratch& scratch,
                    const double* Jbar, double* p) {
  const HistorySpan before{history.before, nullptr, history.flow};
  const CellTask task{s, k, F, before, nullptr, 0.0, scratch, {}};
  const AveragedNeighbours source{{s, k, scratch}, {Jbar + tile_of(s, k).begin, nullptr}};
  visit_law(material_of(s, k).law, history.flow, [&](const auto& law) {
#ifdef TESSERA_WIDE_KERNEL
    if constexpr (InLanes<std::decay_t<decltype(law)>>)
      if (widest_registers() == Registers::eight_numbers) return pressures_of_eight(task, law, source, p);
#endif
    pressures_of_four(task, law, source, p);
  });
}

StressSums averaged_cell_stress_sweep(const System& s, Index k, const Tensor* F, const CellMeans& means,
                                      const HistorySpan& history, ViscousMemory* viscous, double dt,
                                      TileScratch& scratch, const CellStress& stress, const CellReport& report,
                                      const Tensor* at_centroids) {
  const CellTask task{s, k, F, history, viscous, dt, scratch, report, at_centroids};
  const Index begin = tile_of(s, k).begin;
  const AveragedNeighbours source{{s, k, scratch}, {means.J + begin, means.p + begin}};
  [[maybe_unused]] const Registers registers = widest_registers();
  const StressSums sums = visit_law(material_of(s, k).law, history.flow,
                                    [&](const auto& law) { TESSERA_RUN_CELL_KERNEL(task, law, source, registers); });
  return_moments(task, stress, registers);
  return sums;
}

}  // namespace tessera
