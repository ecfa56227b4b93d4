#pragma once

#include <array>
#include <optional>
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

/// What a triangulated surface in a file encloses.
struct SurfaceShape {
  std::string path;
  double unit = 1.0;                  // length of the file's unit [m]
  std::optional<double> split_angle;  // sides are parted by sharper edges [degrees]; else by the file's groups
};

/// A solid as the user describes it. A named shape names its sides "NAME.side".
struct Shape {
  std::string name;
  Origin origin;
  std::variant<BoxShape, UnionShape, DifferenceShape, PolygonShape, SurfaceShape> kind;
};

}  // namespace tessera
