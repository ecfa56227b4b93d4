#include "tessera/geometry/shape_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/geometry/shape_tree.hpp"
#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_load.hpp"
#include "tessera/geometry/surface_transform.hpp"

namespace tessera {
namespace {

constexpr double kOnPlane = 1e-9;  // of the size: how flat a side has to be to count as outermost

/// What is computed in double precision is welded only where that leaves no difference.
constexpr double kComputed = 1e-12;  // of the size

std::vector<Bounds> boxes_of_sides(const TriangleSurface& surface) {
  std::vector<Bounds> boxes(surface.side_names.size());
  for (Index t = 0; t < surface.size(); ++t)
    boxes[static_cast<std::size_t>(surface.side[static_cast<std::size_t>(t)])].include(bounds(surface, t));
  return boxes;
}

/// One end of an axis.
struct Extreme {
  int axis;
  char sign;

  double of(const Bounds& box) const { return (sign == '+' ? box.upper : box.lower)[axis]; }
  std::string name(const std::string& path) const {
    return fmt::format("{}{}{}{}", path, path.empty() ? "" : ".", sign, "xyz"[axis]);
  }
};
constexpr std::array<Extreme, 6> kExtremes{{{0, '-'}, {0, '+'}, {1, '-'}, {1, '+'}, {2, '-'}, {2, '+'}}};

/// Adds "-x" ... "+z" to the names of sides that are flat and outermost in the tree or in one of its parts.
class OutermostNames {
 public:
  OutermostNames(ShapeSurface& shape, const std::vector<std::string>& leaf_names)
      : shape_(shape),
        leaf_names_(leaf_names),
        boxes_(boxes_of_sides(shape.surface)),
        slack_(kOnPlane * norm(bounds(shape.surface).size())) {}

  void add(const SurfaceTree& tree) {
    for (const Index side : tree.sides) add_names(tree, leaf_names_[static_cast<std::size_t>(side)]);
    for (const SurfaceTree& part : tree.parts) add(part);
  }

 private:
  void add_names(const SurfaceTree& tree, const std::string& side) {
    const auto& present = shape_.surface.side_names;
    const auto place = std::find(present.begin(), present.end(), side);
    if (place == present.end()) return;  // booleans have left nothing of it
    const Bounds& box = boxes_[static_cast<std::size_t>(place - present.begin())];
    for (const Extreme& extreme : kExtremes) {
      const double end = extreme.of(tree.box);
      const std::string name = extreme.name(tree.path);
      const bool is_taken = std::find(leaf_names_.begin(), leaf_names_.end(), name) != leaf_names_.end();
      if (!is_taken && std::abs(box.lower[extreme.axis] - end) <= slack_ &&
          std::abs(box.upper[extreme.axis] - end) <= slack_)
        shape_.names[side].push_back(name);
    }
  }

  ShapeSurface& shape_;
  const std::vector<std::string>& leaf_names_;
  std::vector<Bounds> boxes_;
  double slack_;
};

TriangleSurface of_leaf(SurfaceTree& leaf) {
  TriangleSurface surface = transformed(std::move(leaf.surface), leaf.map.A, leaf.map.shift);
  leaf.box = bounds(surface);
  return surface;
}

CheckedSurface checked_result(const Origin& origin, TriangleSurface surface, double tolerance) {
  try {
    return check_surface({"the result", PlaceUnit::line, std::move(surface), {}}, tolerance);
  } catch (const GeometryError& error) {
    throw InputError(origin,
                     fmt::format("parts of the shape come nearer to each other than round-off can tell; let them "
                                 "overlap, share part of a face, or keep them apart. {}",
                                 error.what()));
  }
}

/// Booleans can leave sides without triangles, slivers below round-off, and what bounds no solid.
TriangleSurface of_booleans(ShapeTree& tree) {
  TriangleSurface surface = evaluate(tree.root);
  surface.side_names = tree.side_names;
  const double tolerance = kComputed * norm(bounds(surface).size());
  CheckedSurface checked = checked_result(tree.root.origin, std::move(surface), tolerance);
  tree.notes.push_back(fmt::format("union, difference, intersection: {}", describe(checked)));
  return std::move(checked.surface);
}

/// Far from the origin round-off takes the digits of which areas and volumes are made.
void refuse_far_away(const Shape& shape, const TriangleSurface& surface) {
  constexpr double kFarthest = 1e7;  // in sizes
  const Bounds box = bounds(surface);
  const double size = norm(box.size()), away = std::max(norm(box.lower), norm(box.upper));
  if (away > kFarthest * size)
    throw InputError(shape.origin,
                     fmt::format("the shape is {:.3g} m large and lies {:.3g} m away from the origin, so far "
                                 "that round-off spoils its cells; shift it with translate",
                                 size, away));
}

}  // namespace

ShapeSurface shape_surface(const Shape& shape) {
  ShapeTree tree = tree_of(shape);
  ShapeSurface result;
  if (tree.root.is_leaf()) {
    result.surface = of_leaf(tree.root);
    result.surface.side_names = tree.side_names;
  } else {
    result.surface = of_booleans(tree);
  }
  refuse_far_away(shape, result.surface);
  result.notes = std::move(tree.notes);
  for (const std::string& side : result.surface.side_names) result.names[side] = {side};
  OutermostNames(result, tree.side_names).add(tree.root);
  if (!shape.name.empty())
    for (auto& [side, names] : result.names)
      for (std::size_t n = 0, plain = names.size(); n < plain; ++n) names.push_back(shape.name + "." + names[n]);
  return result;
}

}  // namespace tessera
