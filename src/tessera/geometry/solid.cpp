#include "tessera/geometry/solid.hpp"

#include <algorithm>
#include <set>

#include "tessera/geometry/box_solid.hpp"
#include "tessera/geometry/polygon_solid.hpp"

namespace tessera {

bool Solid::contains(const Vec3& X, double tolerance) const {
  return std::any_of(pieces.begin(), pieces.end(), [&](const ConvexPiece& piece) {
    return std::all_of(piece.walls.begin(), piece.walls.end(),
                       [&](const ConvexPiece::Wall& wall) { return wall.plane.height(X) <= tolerance; });
  });
}

std::vector<std::string> side_names(const Solid& solid) {
  std::set<std::string> names;
  for (const Side& side : solid.sides) names.insert(side.names.begin(), side.names.end());
  return {names.begin(), names.end()};
}

Solid build_solid(const Shape& shape) {
  if (std::holds_alternative<SurfaceShape>(shape.kind))
    throw InputError(shape.origin, "a surface file needs a body of its own, in the voronoi formulation");
  if (const auto* polygon = std::get_if<PolygonShape>(&shape.kind)) return build_polygon_solid(shape, *polygon);
  return build_box_solid(shape);
}

}  // namespace tessera
