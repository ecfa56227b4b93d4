#include "tessera/geometry/shape.hpp"

#include <algorithm>

namespace tessera {

const std::vector<Shape>* parts_of(const Shape& shape) {
  if (const auto* sum = std::get_if<UnionShape>(&shape.kind)) return &sum->parts;
  if (const auto* difference = std::get_if<DifferenceShape>(&shape.kind)) return &difference->parts;
  if (const auto* common = std::get_if<IntersectionShape>(&shape.kind)) return &common->parts;
  return nullptr;
}

namespace {

bool is_made_of_boxes(const Shape& shape) {
  if (shape.move.rotation) return false;
  if (const auto* parts = parts_of(shape)) return std::all_of(parts->begin(), parts->end(), is_made_of_boxes);
  return std::holds_alternative<BoxShape>(shape.kind);
}

}  // namespace

bool has_convex_pieces(const Shape& shape) {
  return is_made_of_boxes(shape) || (std::holds_alternative<PolygonShape>(shape.kind) && !shape.move.rotation);
}

}  // namespace tessera
