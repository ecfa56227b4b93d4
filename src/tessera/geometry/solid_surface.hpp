#pragma once

#include <vector>

#include "tessera/geometry/solid.hpp"
#include "tessera/geometry/surface_sides.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// The boundary of a solid of convex pieces as triangles that share their edges. Each side of the solid gives the side
/// that bears its plainest name; those of equal names become one. What lies in an axis-parallel plane of the solid lies
/// exactly in it.
TriangleSurface surface_of(const Solid& solid);

/// One line per side of the solid, in their order, each called by its plainest name.
std::vector<SideSummary> summarize_sides(const Solid& solid);

}  // namespace tessera
