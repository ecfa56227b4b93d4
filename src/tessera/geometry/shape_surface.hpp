#pragma once

#include <map>
#include <string>
#include <vector>

#include "tessera/geometry/shape.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// The closed surface of a shape, in metres and in place.
struct ShapeSurface {
  TriangleSurface surface;
  std::map<std::string, std::vector<std::string>> names;  // per side of the surface: all names that it answers to
  std::vector<std::string> notes;                         // lines for the user about what was read and mended
};

/// The surface of any shape, curved ones faceted, unions, differences and intersections computed exactly.
///
///     How sides are called:
///     - a box, polygon or file names them as elsewhere, a cylinder or cone "bottom", "top", "mantle", a sphere,
///       ellipsoid or torus "mantle";
///     - a part of a union, difference or intersection puts its NAME or its place in front, "hole.mantle",
///       "part2.mantle"; parts of one name share their sides; a part taken away names the faces that it leaves;
///     - flat sides that are the outermost ones of the shape or of a part, seen along an axis, also answer to "-x" ...
///       "+z" or "NAME.-x" ... "NAME.+z", unless another side is called so.
///
/// Throws InputError at the shape's origin for impossible measures, booleans that leave nothing, and
/// shapes more than 1e7 of their size away from the origin, GeometryError for
/// files and for surfaces that do not bound a solid (surface_check.hpp).
ShapeSurface shape_surface(const Shape& shape);

/// How far facets of a curved shape may be from its true surface when the user says nothing: this part of its largest
/// radius. A circle gets 72 chords.
inline constexpr double kDefaultTolerance = 1e-3;

}  // namespace tessera
