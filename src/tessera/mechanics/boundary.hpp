#pragma once

#include <span>
#include <vector>

#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/system.hpp"

namespace tessera {

/// Calls body(k, a) for every owner of boundary nodes in a tile: its number and the particle.
template <class Body>
void for_each_owner(const System& s, Index tile, Body&& body) {
  for (Index k = s.tiles.tiles[static_cast<std::size_t>(tile)].first_owner; k < s.tiles.end_of(tile).first_owner; ++k)
    body(k, s.owners[static_cast<std::size_t>(k)]);
}

/// Fills the boundary nodes' positions from the walls' current positions and the particles (the closure), [V 24].
void fill_boundary_nodes(const System& s, std::span<const Vec3> walls, Double4* x);

/// Adds the boundary nodes' part (1/V_a) (x_f - x_a) (x) B_af to F of their owners.
void add_boundary_strain(const System& s, const Double4* x, Tensor* F);

/// Boundary bonds of owner number `k`, displacement D (x_f - x_a - F_a X_af), theory (14) and [V 30]: adds their
/// contact stress to its T and their force to its f, and sets `R` to the force on each of its nodes. Returns their
/// energy [J].
double add_boundary_bonds(const System& s, Index k, const Double4* x, const Tensor& F, Columns& T, Double4& f,
                          Double4* R);

/// Adds - T B_af to the force on each node of owner number `k`, whose stress is T.
void add_node_forces(const System& s, Index k, const Columns& T, Double4* R);

/// Hands the forces on nodes back to particles through the transposed closure, and adds D R_f times the wall share to
/// `reactions`: the force on whatever prescribes the node's motion [N].
void drain_boundary_nodes(const System& s, Double4* R, Double4* f, std::span<Vec3> reactions);

/// What the stress P exerts on the particles through the boundary nodes while prescribed branch vectors count as
/// constants, [V 43]: the part of the node forces - P_a B_af that the closure would hand to the walls stays with the
/// owner. `P` holds one stress per owner; `R` is scratch.
void drain_with_held_branches(const System& s, const Columns* P, Double4* R, Double4* f);

/// Reaction force D P_a A_af of constrained faces on their owners, [V 42] and below; its opposite is added to
/// `reactions`. `P` holds one stress per owner.
void add_direct_reactions(const System& s, const Columns* P, Double4* f, std::span<Vec3> reactions);

}  // namespace tessera
