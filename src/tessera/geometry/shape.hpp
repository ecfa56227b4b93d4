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

/// What lies between two discs around one axis, whose radii may differ: a cylinder or a cone.
struct ConeShape {
  Vec3 from, to;                    // the discs' centres [m]
  std::array<double, 2> radii{};    // at `from` and `to`, one of them may be zero [m]
  std::optional<double> tolerance;  // largest distance of a facet from the true surface [m]
};

struct EllipsoidShape {
  Vec3 center, semi_axes;  // along x, y, z [m]
  std::optional<double> tolerance;
};

struct TorusShape {
  Vec3 center, axis;
  double radius = 0.0, tube_radius = 0.0;  // of the circle around the axis, of the tube around that [m]
  std::optional<double> tolerance;
};

/// Everything that is in at least one of the parts.
struct UnionShape {
  std::vector<Shape> parts;
};

/// What is in the first part and in none of the others.
struct DifferenceShape {
  std::vector<Shape> parts;
};

/// What is in all of the parts.
struct IntersectionShape {
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

struct Rotation {
  Vec3 axis;           // its length does not matter
  double angle = 0.0;  // counter-clockwise seen from the tip of the axis [degrees]
  Vec3 about;          // a point that stays [m]
};

/// How a shape is moved once it is made: first scaled from the origin, then turned, then shifted.
struct ShapeMove {
  Vec3 scale{1, 1, 1};  // positive
  std::optional<Rotation> rotation;
  Vec3 translation;  // [m]
};

/// A solid as the user describes it. A named shape names its sides "NAME.side".
struct Shape {
  std::string name;
  Origin origin;
  std::variant<BoxShape, UnionShape, DifferenceShape, IntersectionShape, PolygonShape, SurfaceShape, ConeShape,
               EllipsoidShape, TorusShape>
      kind;
  ShapeMove move = {};
};

/// The parts of a union, difference or intersection; nullptr for all other shapes.
const std::vector<Shape>* parts_of(const Shape& shape);

/// Is the solid made of boxes or of one polygon that are nowhere turned, so that build_solid can make convex pieces of
/// it? All others need their surface (shape_surface.hpp).
bool has_convex_pieces(const Shape& shape);

}  // namespace tessera
