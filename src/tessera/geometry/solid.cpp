#include "tessera/geometry/solid.hpp"

#include <algorithm>
#include <set>

#include "tessera/geometry/box_solid.hpp"
#include "tessera/geometry/polygon_solid.hpp"
#include "tessera/geometry/shape_move.hpp"

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
  if (!has_convex_pieces(shape)) throw InputError(shape.origin, "only boxes and polygons have convex pieces");
  const Shape in_place = settled(shape);
  if (const auto* polygon = std::get_if<PolygonShape>(&in_place.kind)) return build_polygon_solid(in_place, *polygon);
  return build_box_solid(in_place);
}

}  // namespace tessera
