#pragma once

#include <span>
#include <string>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/geometry/shape.hpp"

namespace tessera {

/// The half space normal . X <= offset; `normal` is a unit vector that points out of the solid.
struct Plane {
  Vec3 normal;
  double offset = 0.0;

  double height(const Vec3& X) const { return dot(normal, X) - offset; }
};

/// A flat part of a solid's boundary that users may name. Several sides may lie in one plane, and several sides may
/// share a name.
struct Side {
  std::vector<std::string> names;  // at least one, the plainest first
  Plane plane;
};

/// One convex piece of a solid: an intersection of half spaces. Every wall is either wholly on the solid's
/// boundary (`side` >= 0, an index into Solid::sides) or wholly shared with another piece (`side` = -1).
struct ConvexPiece {
  struct Wall {
    Plane plane;
    Index side = -1;
  };
  std::vector<Wall> walls;
  Vec3 lower, upper;  // bounding box [m]
};

/// A solid as disjoint convex pieces that together fill it.
///
///      +----+               How the flat faces of a solid are called:
///      | 2  |               - the outermost ones of the whole body, seen along an axis: "-x" ... "+z";
///      +----+-------+       - of an extruded polygon: "edge1", "edge2", ... in the order of its points, "-z", "+z";
///      |     1      |       - of a part that has a NAME: "NAME.-x" ... "NAME.+z" for its own outermost faces
///      +------------+         (of a part taken away: the faces that it leaves), "NAME.edge1" ...;
///                           - what is nameless by now: "part2.+x", by the place of the part in its union or
///                             difference ("part1.part2.+x" when nested).
struct Solid {
  std::vector<ConvexPiece> pieces;
  std::vector<Side> sides;
  Vec3 lower, upper;    // bounding box [m]
  double volume = 0.0;  // [m3]

  /// Is X inside or within `tolerance` [m] of the boundary?
  bool contains(const Vec3& X, double tolerance) const;
};

/// Every name that a side of the solid bears, sorted, each once.
std::vector<std::string> side_names(const Solid& solid);

/// Builds the solid of a shape that has_convex_pieces. Throws InputError at the shape's origin for empty boxes,
/// polygons that cross themselves, differences and intersections that leave nothing, and other shapes.
Solid build_solid(const Shape& shape);

}  // namespace tessera
