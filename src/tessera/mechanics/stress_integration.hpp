#pragma once

#include <memory>

#include "tessera/mechanics/cell_sweeps.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/parallel/workspaces.hpp"

namespace tessera {

/// Where bonds put their forces; null: bonds are left out.
struct BondTarget {
  Double4* f = nullptr;  // of particles
  Double4* R = nullptr;  // of boundary nodes
};

/// Of what stresses are to be found, and what is wanted beside them.
struct StressTask {
  const Double4* x = nullptr;  // positions of particles and boundary nodes [m]
  const Tensor* F = nullptr;
  HistorySpan history{};
  BondTarget bonds{};
  ViscousMemory* viscous = nullptr;        // takes the viscous stress that the deformation since the last one makes ...
  double dt = 0.0;                         // ... in this time [s]
  const Tensor* viscous_stress = nullptr;  // known already, one a particle [Pa]; null: none
  CellReport report{};
};

/// How the strain energy is integrated over the cells: what deformations follow from positions, stresses from
/// deformations, and forces from stresses. Stresses come in two passes over the tiles: `gather` does what neighbours
/// must know before theirs are complete, `stresses` completes those of one tile. An object keeps what lies between the
/// two.
class StressIntegration {
 public:
  using Scratches = parallel::Workspaces<TileScratch>;

  StressIntegration(const System& s, Scratches& scratches) : s_(s), scratches_(scratches) {}
  StressIntegration(const StressIntegration&) = delete;
  StressIntegration& operator=(const StressIntegration&) = delete;
  virtual ~StressIntegration() = default;

  /// Another one at the same deformation, with memory of its own: what it does leaves this one alone.
  virtual std::unique_ptr<StressIntegration> apart() const = 0;

  /// Sets F, but for what boundary nodes do.
  virtual void find_strain(const Double4* x, Tensor* F);
  /// The first pass, when F is complete.
  virtual StressSums gather(const StressTask& /*task*/) { return {}; }
  /// The second: the stresses by which a tile's own particles act on boundary nodes, in T and, where the scratch has
  /// room for it, the elastic and viscous part in P.
  virtual StressSums stresses(const StressTask& task, Index tile, TileScratch& scratch) = 0;
  /// Adds the forces of T on the tile's own particles to `f`, and sets those on its rim, `rim_f`.
  virtual void act(Index tile, const TileScratch& scratch, Double4* f, Double4* rim_f) const;

  /// The deformation that the law sees at particle a.
  virtual Mat3 law_deformation(std::size_t /*a*/, const Tensor& F) const { return to_mat3(F); }

 protected:
  const System& s_;
  Scratches& scratches_;
};

/// The integration that the system is made for.
std::unique_ptr<StressIntegration> make_integration(const System& s, StressIntegration::Scratches& scratches);
std::unique_ptr<StressIntegration> nodal_integration(const System& s, StressIntegration::Scratches& scratches);
std::unique_ptr<StressIntegration> cell_integration(const System& s, StressIntegration::Scratches& scratches);
std::unique_ptr<StressIntegration> second_order_integration(const System& s, StressIntegration::Scratches& scratches);

// What integrations share.

/// Sums body(tile, scratch) over all tiles.
template <class Body>
StressSums sum_tiles(const System& s, StressIntegration::Scratches& scratches, Body&& body) {
  return parallel::sum_tasks<StressSums>(s.tiles.size(), [&](std::int64_t tile) {
    const StressIntegration::Scratches::Lease scratch(scratches);
    return body(static_cast<Index>(tile), *scratch);
  });
}

/// Bonds between particles: copies the values of a tile and its rim, adds forces, sets T to the contact stress,
/// [D 57, 58]. Returns their energy [J]. Where bonds are left out, T is zero and nothing else done.
double add_tile_bonds(const System& s, Index tile, const StressTask& task, TileScratch& scratch);
/// The same at the boundary nodes of the tile's particles, when T has its other parts.
double add_tile_boundary_bonds(const System& s, Index tile, const StressTask& task, TileScratch& scratch);
/// Adds the viscous stress that is known already to the stress of the tile's own particles and to its report.
void add_known_viscous_stress(const System& s, Index tile, const StressTask& task, TileScratch& scratch);

}  // namespace tessera
