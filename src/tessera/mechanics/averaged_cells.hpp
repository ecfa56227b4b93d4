#pragma once

#include "tessera/mechanics/cell_sweeps.hpp"

// Cell integration where laws see the mean change of volume around a cell (theory, section 8): the E_q follow from the
// neighbours' F, so three passes over the tiles find J of all cells, then p of all, then stresses.

namespace tessera {

/// Means over the neighbours of all cells, one entry a particle.
struct CellMeans {
  const double* J;  // Jbar = S S J
  const double* p;  // S S p [Pa]
};

/// J_a of the tile's own cells by F at their centroids. Needs the nodes of the tile, as all of these.
void volume_sweep(const System& s, Index tile, const Tensor* F, TileScratch& scratch, double* J);

/// p_a of the tile's own cells, the mean Cauchy stress that the law gives at their points, by Jbar and F at their
/// centroids. Histories stay.
void pressure_sweep(const System& s, Index tile, const Tensor* F, const HistorySpan& history, TileScratch& scratch,
                    const double* Jbar, double* p);

/// As cell_stress_sweep.
StressSums averaged_cell_stress_sweep(const System& s, Index tile, const Tensor* F, const CellMeans& means,
                                      const HistorySpan& history, ViscousMemory* viscous, double dt,
                                      TileScratch& scratch, const CellStress& stress, const CellReport& report,
                                      const Tensor* at_centroids = nullptr);

}  // namespace tessera
