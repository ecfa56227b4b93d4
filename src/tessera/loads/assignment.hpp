#pragma once

#include <span>
#include <vector>

#include "tessera/base/mat3.hpp"
#include "tessera/loads/boundary_condition.hpp"
#include "tessera/loads/surface.hpp"

namespace tessera {

/// A condition's share in a prescribed displacement: M u_condition(t, X).
struct MotionPart {
  const BoundaryCondition* condition = nullptr;
  Mat3 M;
};

/// What is prescribed at one point: the projection D onto the constrained directions, [V 14], and from whom the motion
/// comes, D u_bar = sum M u_condition.
struct PointConstraint {
  Mat3 D;
  std::vector<MotionPart> parts;
};

/// A traction entry on one piece of the surface.
struct LoadedPiece {
  Index piece = 0;
  const BoundaryCondition* condition = nullptr;
};

/// Constraints of the faces of a voronoi body, one per piece. Throws InputError when an entry takes nothing, and when
/// two entries constrain the same component of one face (names both).
std::vector<PointConstraint> constrain_faces(const Surface& surface,
                                             std::span<const BoundaryCondition* const> conditions);

/// Constraints of the particles of a delaunay body, one per particle (zero D inside and where nothing is said). Entries
/// may overlap at edges and corners as long as they prescribe the same motion at the times 0, 0.37 and 1 of `end`;
/// otherwise InputError that names both, as when a symmetric or antisymmetric entry takes a particle without a normal.
/// `X` are the particles' material positions.
std::vector<PointConstraint> constrain_particles(const Surface& surface, std::span<const Vec3> X,
                                                 std::span<const BoundaryCondition* const> conditions, double end);

/// The pieces that traction and pressure entries take; several may act on one piece and add up. Throws InputError
/// when an entry takes nothing.
std::vector<LoadedPiece> load_pieces(const Surface& surface, std::span<const BoundaryCondition* const> conditions);

}  // namespace tessera
