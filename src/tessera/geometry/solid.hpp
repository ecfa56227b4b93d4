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

/// A flat part of a solid's boundary that users may name. Several sides may lie in one plane.
struct Side {
  std::string name;
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
///      +----+               side names of an extruded polygon: "edge1", "edge2", ... in the order of
///      | 2  |               its points, "-z" (base) and "+z" (top); of a box: "-x" ... "+z"; of a
///      +----+-------+       union or difference: the names of its parts' sides that remain, and the
///      |     1      |       outermost flat faces as "-x" ... "+z"
///      +------------+
struct Solid {
  std::vector<ConvexPiece> pieces;
  std::vector<Side> sides;
  Vec3 lower, upper;    // bounding box [m]
  double volume = 0.0;  // [m3]

  /// Is X inside or within `tolerance` [m] of the boundary?
  bool contains(const Vec3& X, double tolerance) const;
};

/// Builds the solid of a shape. Throws InputError at the shape's origin for empty boxes, polygons that cross
/// themselves, differences that leave nothing, and unions or differences of anything but boxes.
Solid build_solid(const Shape& shape);

}  // namespace tessera
