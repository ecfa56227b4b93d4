#include "tessera/geometry/shape_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "tessera/geometry/file_place.hpp"
#include "tessera/geometry/shape_surface.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/geometry/solid_surface.hpp"
#include "tessera/geometry/surface_load.hpp"
#include "tessera/geometry/surface_primitives.hpp"
#include "tessera/geometry/surface_sides.hpp"
#include "tessera/geometry/surface_transform.hpp"

namespace tessera {
namespace {

/// Makes a tree of surfaces of a shape, collecting the names of their sides.
class Builder {
 public:
  ShapeTree build(const Shape& shape) {
    found_.root = tree(shape, "");
    return std::move(found_);
  }

 private:
  SurfaceTree tree(const Shape& shape, const std::string& path) {
    SurfaceTree node;
    node.origin = shape.origin;
    node.path = path;
    node.map = map_of(shape.move);
    if (const auto* parts = parts_of(shape)) {
      add_parts(shape, *parts, node);
    } else {
      node.surface = leaf(shape);
      rename_sides(node);
    }
    return node;
  }

  void add_parts(const Shape& shape, const std::vector<Shape>& parts, SurfaceTree& node) {
    node.boolean = std::holds_alternative<UnionShape>(shape.kind)        ? Boolean::unite
                   : std::holds_alternative<DifferenceShape>(shape.kind) ? Boolean::subtract
                                                                         : Boolean::intersect;
    std::set<Index> sides;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const std::string by_place = fmt::format("{}{}part{}", node.path, node.path.empty() ? "" : ".", p + 1);
      node.parts.push_back(tree(parts[p], parts[p].name.empty() ? by_place : parts[p].name));
      sides.insert(node.parts.back().sides.begin(), node.parts.back().sides.end());
    }
    node.sides.assign(sides.begin(), sides.end());
  }

  TriangleSurface leaf(const Shape& shape) {
    try {
      if (const auto* file = std::get_if<SurfaceShape>(&shape.kind)) {
        require_file(file->path, shape.origin);
        return of_file(*file);
      }
      if (const auto* cone = std::get_if<ConeShape>(&shape.kind)) return surface_of(*cone);
      if (const auto* ellipsoid = std::get_if<EllipsoidShape>(&shape.kind)) return surface_of(*ellipsoid);
      if (const auto* torus = std::get_if<TorusShape>(&shape.kind)) return surface_of(*torus);
    } catch (const GeometryError& error) {
      if (std::holds_alternative<SurfaceShape>(shape.kind)) throw;  // names the file itself
      throw InputError(shape.origin, error.what());
    }
    return of_pieces(shape);
  }

  /// A box or polygon. Edges of a polygon keep their own names.
  static TriangleSurface of_pieces(Shape shape) {
    shape.move = {};
    shape.name.clear();
    Solid solid = build_solid(shape);
    for (Side& side : solid.sides) side.names = {side.names.back()};
    TriangleSurface surface = tessera::surface_of(solid);
    if (const auto* polygon = std::get_if<PolygonShape>(&shape.kind)) put_on_corners(*polygon, surface);
    return surface;
  }

  /// Gives vertices the numbers that the user wrote, which intersections of planes miss by round-off.
  static void put_on_corners(const PolygonShape& polygon, TriangleSurface& surface) {
    const double top = polygon.base + polygon.thickness;
    for (Vec3& X : surface.vertices) {
      const auto distance2 = [&X](const std::array<double, 2>& p) { return norm2(X - Vec3{p[0], p[1], X.z}); };
      const auto nearest = std::min_element(polygon.points.begin(), polygon.points.end(),
                                            [&](const auto& p, const auto& q) { return distance2(p) < distance2(q); });
      X = {(*nearest)[0], (*nearest)[1], std::abs(X.z - polygon.base) < std::abs(X.z - top) ? polygon.base : top};
    }
  }

  TriangleSurface of_file(const SurfaceShape& file) {
    CheckedSurface checked = load_surface(file.path, file.unit);
    if (file.split_angle) split_sides_at_edges(checked.surface, *file.split_angle);
    found_.notes.push_back(
        fmt::format("{}: {}", std::filesystem::path(file.path).filename().string(), describe(checked)));
    note_size(file, norm(bounds(checked.surface).size()));
    return std::move(checked.surface);
  }

  /// A file says nothing of its unit, so that a wrong one shows only in the size.
  void note_size(const SurfaceShape& file, double size) {
    constexpr double kLarge = 10.0, kSmall = 1e-3;  // of parts drawn in mm but read in m, and the other way round [m]
    if (file.unit == 1.0 && size > kLarge)
      found_.notes.push_back(
          fmt::format("  it is {:.3g} m large: was it drawn in another unit than units = \"m\"?", size));
    if (file.unit < 1.0 && size < kSmall)
      found_.notes.push_back(
          fmt::format("  it is {:.3g} m large: was it drawn in a larger unit than units says?", size));
  }

  static double tolerance_of(const std::optional<double>& given, double radius) {
    return given.value_or(kDefaultTolerance * radius);
  }

  static TriangleSurface surface_of(const ConeShape& cone) {
    const auto [bottom, top] = cone.radii;
    return cone_surface(cone.from, cone.to, bottom, top, tolerance_of(cone.tolerance, std::max(bottom, top)));
  }

  static TriangleSurface surface_of(const EllipsoidShape& ellipsoid) {
    const Vec3& axes = ellipsoid.semi_axes;
    const double tolerance = tolerance_of(ellipsoid.tolerance, std::max({axes.x, axes.y, axes.z}));
    return transformed(ellipsoid_surface(axes, tolerance), identity(), ellipsoid.center);
  }

  static TriangleSurface surface_of(const TorusShape& torus) {
    const double tolerance = tolerance_of(torus.tolerance, torus.radius + torus.tube_radius);
    return transformed(torus_surface(torus.radius, torus.tube_radius, tolerance), frame_along(torus.axis),
                       torus.center);
  }

  /// Gives the sides of a leaf their numbers in the list of all.
  void rename_sides(SurfaceTree& leaf) {
    std::vector<Index> number;
    std::vector<std::string>& side_names = found_.side_names;
    for (const std::string& own : leaf.surface.side_names) {
      const std::string name = leaf.path.empty() ? own : leaf.path + "." + own;
      const auto found = std::find(side_names.begin(), side_names.end(), name);
      number.push_back(static_cast<Index>(found - side_names.begin()));
      if (found == side_names.end()) side_names.push_back(name);
    }
    for (Index& side : leaf.surface.side) side = number[static_cast<std::size_t>(side)];
    std::sort(number.begin(), number.end());
    leaf.sides = std::move(number);
    leaf.surface.side_names.clear();
  }

  ShapeTree found_;
};

}  // namespace

ShapeTree tree_of(const Shape& shape) { return Builder().build(shape); }

}  // namespace tessera
