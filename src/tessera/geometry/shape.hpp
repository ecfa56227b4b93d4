#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

struct Shape;

/// The axis-parallel box between two corners [m].
struct BoxShape {
  Vec3 min, max;
};

/// Everything that is in at least one of the parts.
struct UnionShape {
  std::vector<Shape> parts;
};

/// What is in the first part and in none of the others.
struct DifferenceShape {
  std::vector<Shape> parts;
};

/// A simple polygon in the plane z = base, extruded by `thickness` along z [m].
struct PolygonShape {
  std::vector<std::array<double, 2>> points;
  double base = 0.0;
  double thickness = 0.0;
};

/// A solid as the user describes it. A named shape names its sides "NAME.side".
struct Shape {
  std::string name;
  Origin origin;
  std::variant<BoxShape, UnionShape, DifferenceShape, PolygonShape> kind;
};

}  // namespace tessera
