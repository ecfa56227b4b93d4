#pragma once

#include "tessera/geometry/solid.hpp"

namespace tessera {

/// The solid of an extruded polygon, in prisms over the convex parts of the polygon. Errors as for build_solid.
Solid build_polygon_solid(const Shape& shape, const PolygonShape& polygon);

}  // namespace tessera
