#include <fmt/format.h>

#include "tessera/base/units.hpp"
#include "tessera/input/build_parts.hpp"

namespace tessera::input {

namespace {

std::vector<Shape> build_shapes(const Reader& t, const std::string& key) {
  std::vector<Shape> shapes;
  for (const Reader& part : t.tables(key)) shapes.push_back(build_shape(part));
  if (shapes.size() < 2)
    throw InputError(t.origin_of(key), fmt::format("found {} shape; expected at least two", shapes.size()));
  return shapes;
}

PolygonShape build_polygon(const Reader& t) {
  PolygonShape polygon;
  for (const Value& point : *t.value("points").get_if<Array>()) {
    const Array& pair = *point.get_if<Array>();
    polygon.points.push_back({number_of(pair.at(0)), number_of(pair.at(1))});
  }
  polygon.base = t.number("base");
  polygon.thickness = t.number("thickness");
  return polygon;
}

SurfaceShape build_surface(const Reader& t) {
  const DimensionalResult unit = read_quantity("1 " + t.text("units"));
  return {t.text("file"), unit.quantity->value, t.optional_number("split_angle")};
}

ConeShape build_cone(const Reader& t, double top_radius) {
  const Vec3 from = t.vector("from"), to = t.vector("to");
  if (from == to) throw InputError(t.origin_of("to"), "found the same point as from; expected another one");
  return {from, to, {t.number("radius"), top_radius}, t.optional_number("tolerance")};
}

EllipsoidShape build_sphere(const Reader& t) {
  const double radius = t.number("radius");
  return {t.vector("center"), {radius, radius, radius}, t.optional_number("tolerance")};
}

Vec3 build_direction(const Reader& t, const std::string& key) {
  const Vec3 direction = t.vector(key);
  if (norm(direction) == 0.0)
    throw InputError(t.origin_of(key), "found a vector of no length; expected a direction, as in [0, 0, 1]");
  return direction;
}

TorusShape build_torus(const Reader& t) {
  const TorusShape torus{t.vector("center"), build_direction(t, "axis"), t.number("radius"), t.number("tube_radius"),
                         t.optional_number("tolerance")};
  if (torus.tube_radius >= torus.radius)
    throw InputError(t.origin_of("tube_radius"),
                     fmt::format("found {} m; expected less than the radius {} m", torus.tube_radius, torus.radius));
  return torus;
}

ShapeMove build_move(const Reader& t) {
  ShapeMove move;
  if (t.has("scale")) move.scale = t.vector("scale");
  if (t.has("rotate")) {
    const Reader r = t.table("rotate");
    move.rotation = Rotation{build_direction(r, "axis"), r.number("angle"), r.vector("about")};
  }
  if (t.has("translate")) move.translation = t.vector("translate");
  return move;
}

}  // namespace

Shape build_shape(const Reader& t) {
  Shape shape;
  shape.name = t.text_or_empty("name");
  shape.origin = t.origin();
  if (t.has("box")) shape.kind = BoxShape{t.table("box").vector("min"), t.table("box").vector("max")};
  if (t.has("polygon")) shape.kind = build_polygon(t.table("polygon"));
  if (t.has("cylinder")) shape.kind = build_cone(t.table("cylinder"), t.table("cylinder").number("radius"));
  if (t.has("cone")) shape.kind = build_cone(t.table("cone"), t.table("cone").number("top_radius"));
  if (t.has("sphere")) shape.kind = build_sphere(t.table("sphere"));
  if (t.has("ellipsoid")) {
    const Reader e = t.table("ellipsoid");
    shape.kind = EllipsoidShape{e.vector("center"), e.vector("semi_axes"), e.optional_number("tolerance")};
  }
  if (t.has("torus")) shape.kind = build_torus(t.table("torus"));
  if (t.has("file")) shape.kind = build_surface(t);
  if (t.has("union")) shape.kind = UnionShape{build_shapes(t, "union")};
  if (t.has("difference")) shape.kind = DifferenceShape{build_shapes(t, "difference")};
  if (t.has("intersection")) shape.kind = IntersectionShape{build_shapes(t, "intersection")};
  shape.move = build_move(t);
  return shape;
}

}  // namespace tessera::input
