#pragma once

#include "tessera/mechanics/sweeps.hpp"

// Cell integration (theory, section 11): in place of V_a U(F_a) the potential has the mean of U over six points of each
// cell, F_a -+ E_q, with E = G_a A_a, G_a = sum_b (F_b - F_a) (x) C_ab / r^2 over the neighbours with a common face.

namespace tessera {

/// What cells keep from the sweep over their points until stresses are complete.
struct CellMemory {
  Field<Tensor> T;                // stress that the bonds hand on, without what other tiles add [Pa]
  Field<Tensor> P;                // elastic and viscous part of it where it goes another way, else empty
  RawField<Tensor> rim_energies;  // what a tile's cells add to V_b T_b of its rim [J]
};

/// Where the stresses of cells go, one entry a particle and one a place in a rim.
struct CellStress {
  Tensor* own;  // that the bonds hand on, or its elastic and viscous part where the scratch has room for it [Pa]
  Tensor* rim;  // what a tile's cells add to V_b T_b of its rim [J]
};

/// What is wanted of single cells beside their forces, one entry a particle or null.
struct CellReport {
  Tensor* mean = nullptr;        // of the stress over the cell, without viscosity [Pa]
  double* smallest_J = nullptr;  // of the points
  double* energy = nullptr;      // mean over the cell [J/m3]
};

/// The elastic and viscous stress of the tile's own particles by their points: adds it, and what the moments of the
/// points' stresses do to the tile's own F_b, to the scratch's T (or P, where there is room for it) and leaves it in
/// `stress`, along with what they do to those of the rim. Needs the nodes that contact_sweep has left. `at_centroids`
/// is F at the centroids of cells, where some F_a belong elsewhere.
StressSums cell_stress_sweep(const System& s, Index tile, const Tensor* F, const HistorySpan& history,
                             ViscousMemory* viscous, double dt, TileScratch& scratch, const CellStress& stress,
                             const CellReport& report, const Tensor* at_centroids = nullptr);

/// The same on four cells at once, whatever the processor. Its stresses have the same bits.
StressSums cell_stress_sweep_of_four(const System& s, Index tile, const Tensor* F, const HistorySpan& history,
                                     ViscousMemory* viscous, double dt, TileScratch& scratch, const CellStress& stress,
                                     const CellReport& report);

/// Puts the tile's nodes into the scratch where there is no contact_sweep before.
void load_tile(const System& s, Index tile, const Double4* x, const Tensor* F, TileScratch& scratch);

/// The stresses of the tile's own particles, `own` with what the cells of other tiles have put into their rims. Brings
/// the tile's gradient vectors near, which forces need next.
void complete_stresses(const System& s, Index tile, const Tensor* own, const Tensor* rims, Columns* T);

}  // namespace tessera
