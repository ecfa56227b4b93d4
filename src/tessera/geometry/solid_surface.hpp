#pragma once

#include "tessera/geometry/solid.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// The boundary of a solid of convex pieces as triangles that share their edges. Each side of the solid gives the side
/// that bears its plainest name; those of equal names become one. What lies in an axis-parallel plane of the solid lies
/// exactly in it.
TriangleSurface surface_of(const Solid& solid);

}  // namespace tessera
