#include "tessera/geometry/shape_move.hpp"

#include "tessera/geometry/surface_transform.hpp"

namespace tessera {
namespace {

/// Moves that do not turn.
struct Stretch {
  Vec3 scale{1, 1, 1}, shift;

  double of(double x, int d) const { return scale[d] * x + shift[d]; }
  Vec3 operator()(const Vec3& X) const { return {of(X.x, 0), of(X.y, 1), of(X.z, 2)}; }
};

/// `inner` first, then `outer`.
Stretch after(const Stretch& outer, const ShapeMove& inner) {
  Stretch both{{}, outer(inner.translation)};
  for (int d = 0; d < 3; ++d) both.scale[d] = outer.scale[d] * inner.scale[d];
  return both;
}

std::vector<Shape> settled(const std::vector<Shape>& parts, const Stretch& stretch);

Shape settled(Shape shape, const Stretch& outer) {
  const Stretch stretch = after(outer, shape.move);
  shape.move = {};
  if (auto* box = std::get_if<BoxShape>(&shape.kind)) *box = {stretch(box->min), stretch(box->max)};
  if (auto* polygon = std::get_if<PolygonShape>(&shape.kind)) {
    for (auto& [x, y] : polygon->points) {
      x = stretch.of(x, 0);
      y = stretch.of(y, 1);
    }
    polygon->base = stretch.of(polygon->base, 2);
    polygon->thickness *= stretch.scale.z;
  }
  if (auto* sum = std::get_if<UnionShape>(&shape.kind)) sum->parts = settled(sum->parts, stretch);
  if (auto* difference = std::get_if<DifferenceShape>(&shape.kind))
    difference->parts = settled(difference->parts, stretch);
  if (auto* common = std::get_if<IntersectionShape>(&shape.kind)) common->parts = settled(common->parts, stretch);
  return shape;
}

std::vector<Shape> settled(const std::vector<Shape>& parts, const Stretch& stretch) {
  std::vector<Shape> result;
  for (const Shape& part : parts) result.push_back(settled(part, stretch));
  return result;
}

}  // namespace

AffineMap map_of(const ShapeMove& move) {
  const Mat3 S = diagonal(move.scale.x, move.scale.y, move.scale.z);
  if (!move.rotation) return {S, move.translation};
  const Mat3 R = rotation(move.rotation->axis, move.rotation->angle);
  const Vec3& about = move.rotation->about;
  return {R * S, about - R * about + move.translation};
}

Shape settled(const Shape& shape) { return settled(shape, Stretch{}); }

}  // namespace tessera
