#pragma once

#include <array>
#include <vector>

#include "tessera/base/error.hpp"

namespace tessera {

using Point2 = std::array<double, 2>;

/// Throws InputError at `origin` unless the points are the corners of a simple polygon: at least three, all finite,
/// none doubled, no two edges meeting but at their common corner, and an area that is not zero. Points and edges are
/// counted from one: edge i goes from point i to the next.
void check_polygon(const std::vector<Point2>& points, const Origin& origin);

/// Signed area, positive for counter-clockwise order [m2].
double polygon_area(const std::vector<Point2>& points);

/// Splits a simple counter-clockwise polygon along diagonals into strictly convex parts, given as loops of point
/// numbers. Every edge of a part is an edge of the polygon or a whole edge of exactly one other part.
std::vector<std::vector<int>> convex_parts(const std::vector<Point2>& points);

}  // namespace tessera
