#pragma once

#include "tessera/mechanics/cell_sweeps.hpp"

namespace tessera {

/// The elastic and viscous stress of the tile's own particles by the points of their cells, added to T or put into P as
/// cell_stress_sweep does: F varies by the second derivatives of cells in `memory`, and in unresolved cells as
/// find_unresolved_strains has found. What the stresses do by second derivatives is left in `memory`.
StressSums curved_stress_sweep(const System& s, Index tile, const Tensor* F, const HistorySpan& history,
                               ViscousMemory* viscous, double dt, TileScratch& scratch, SecondOrderMemory& memory,
                               const CellReport& report);

}  // namespace tessera
