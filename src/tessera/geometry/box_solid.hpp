#pragma once

#include "tessera/geometry/solid.hpp"

namespace tessera {

/// The solid of a box, or of unions and differences of boxes, cut along a grid through the boxes' coordinates.
/// Coordinates that differ by less than 1e-12 of the whole size count as equal. Errors as for build_solid.
Solid build_box_solid(const Shape& shape);

}  // namespace tessera
