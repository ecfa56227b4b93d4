#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/laws/material.hpp"
#include "tessera/laws/viscosity.hpp"
#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/second_order.hpp"
#include "tessera/mechanics/tiles.hpp"
#include "tessera/mechanics/volume_average.hpp"

namespace tessera {

/// Consecutive particles of one material.
struct MaterialRange {
  Index begin = 0;
  Index end = 0;
  Index material = 0;
  double shortest_bond = 0.0;  // between particles with a common face [m]
};

/// A boundary node as the force calculation needs it.
struct NodeMechanics {
  Vec3 X_af;       // reference position relative to the owner [m]
  Mat3 stiffness;  // of the boundary bond, in directions that do not turn [N/m]
  double along_N;  // what is added along the present direction of N, F_a N / |F_a N| [N/m]
};

/// How much of the force on boundary node `node` a particle (or a fully prescribed node) receives.
struct ReturnTerm {
  Index node = 0;
  double constrained = 0.0;  // factor of D R_f
  double free = 0.0;         // factor of (I - D) R_f
};

/// Everything that does not change during a run. Nodes are the particles followed by the boundary nodes.
struct System {
  Discretization d;  // without its bonds, which the tiles hold
  Tiles tiles;
  double shortest_length = 0.0;  // of the bonds between particles and to ghosts [m]
  std::vector<Material> materials;
  std::vector<MaterialRange> ranges;  // ascending, cover all particles
  std::vector<double> mass;           // [kg]

  std::vector<NodeMechanics> nodes;
  std::vector<Index> owners;         // particles that own boundary nodes, ascending
  std::vector<Index> first_node;     // of each owner; one more entry at the end
  std::vector<Index> receivers;      // particles that a closure names, ascending
  Csr<ReturnTerm> returned;          // the transposed closure: one row per receiver
  Csr<ReturnTerm> returned_to_node;  // the same for nodes that other nodes follow: one row per boundary node

  std::optional<CellGradients> gradients;         // where cells are integrated by cubature
  MovedMeans returned_means;                      // P_a in T_b of other cells, where F is moved to centroids
  std::optional<VolumeAverage> average;           // where laws see a mean change of volume
  std::optional<SecondOrderSystem> second_order;  // set for second-order integration only

  std::vector<ViscosityLaw> viscosity;  // per particle; empty when no material is viscous
  Index stress_points = 1;              // of each particle: where laws are evaluated

  Index particles() const { return d.particles(); }
  /// Some material keeps a history.
  bool plastic() const {
    return std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.plastic(); });
  }
  Index boundary_nodes() const { return static_cast<Index>(d.nodes.size()); }
};

/// Puts a system together. `material_of` gives the material of each particle; equal ones must be consecutive within a
/// body. `particles_per_tile` zero: tile_size().
System make_system(Discretization d, std::vector<Material> materials, const std::vector<Index>& material_of,
                   Index particles_per_tile = 0, Volumetric volumetric = Volumetric::standard);

}  // namespace tessera
