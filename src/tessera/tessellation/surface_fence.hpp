#pragma once

#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// Points around a solid that keep the Voronoi cells of its particles from reaching far into the void.
///
///      . . . . . . .
///      .           .      Each is at least `distance` away from the solid, and no way out passes between them at
///      .  +-----+  .      more than about half of `distance` from the next. So they take nothing of a solid whose
///      .  |solid|  .      points all have a particle within `distance`.
///      .  +-----+  .
///      . . . . . . .
///
/// Where `distance` [m] is so small that the grid behind it would not fit into memory, a larger one is taken. The same
/// surface and distance give the same points.
std::vector<Vec3> fence_points(const TriangleSurface& surface, double distance);

/// Particles, the fence around them, and the corners of a tetrahedron far around all: what DualCellCutter wants.
std::vector<Vec3> enclosed_generators(std::span<const Vec3> particles, std::span<const Vec3> fence);

}  // namespace tessera
