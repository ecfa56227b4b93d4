#pragma once

#include "tessera/base/mat3.hpp"
#include "tessera/geometry/shape.hpp"

namespace tessera {

/// X -> A X + shift.
struct AffineMap {
  Mat3 A = identity();
  Vec3 shift;

  Vec3 operator()(const Vec3& X) const { return A * X + shift; }
  bool is_identity() const { return A == identity() && shift == Vec3{}; }
};

/// What a move does to a point: scale, then turn about its point, then shift. Exact for quarter turns around the
/// coordinate axes about the origin.
AffineMap map_of(const ShapeMove& move);

/// The same shape, which has convex pieces, with the moves of all its parts worked into their coordinates.
Shape settled(const Shape& shape);

}  // namespace tessera
