#include "tessera/geometry/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

/// Normals closer to the span of others than this (sine of the angle) add no constraint.
constexpr double kParallel = 1e-6;

/// Orthonormal vectors that span the normals of `sides`.
std::vector<Vec3> normal_space(const Solid& solid, const std::vector<Index>& sides) {
  std::vector<Vec3> basis;
  for (const Index side : sides) {
    Vec3 n = solid.sides[static_cast<std::size_t>(side)].plane.normal;
    for (const Vec3& e : basis) n -= dot(n, e) * e;
    if (norm(n) > kParallel) basis.push_back(normalized(n));
  }
  return basis;
}

}  // namespace

std::vector<Index> sides_at(const Solid& solid, const Vec3& X, double tolerance) {
  std::vector<Index> sides;
  for (const ConvexPiece& piece : solid.pieces) {
    double highest = -1e300;
    for (const ConvexPiece::Wall& wall : piece.walls) highest = std::max(highest, wall.plane.height(X));
    if (std::abs(highest) > tolerance) continue;
    for (const ConvexPiece::Wall& wall : piece.walls)
      if (wall.side >= 0 && wall.plane.height(X) >= -tolerance) sides.push_back(wall.side);
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

bool is_well_inside(const Solid& solid, const Vec3& X, double tolerance) {
  return solid.contains(X, tolerance) && sides_at(solid, X, tolerance).empty();
}

Vec3 moved_onto(const Solid& solid, const std::vector<Index>& sides, Vec3 X) {
  for (int sweep = 0; sweep < 8; ++sweep)  // alternating projections, for oblique planes that are not orthogonal
    for (const Index side : sides) {
      const Plane& plane = solid.sides[static_cast<std::size_t>(side)].plane;
      X -= plane.height(X) * plane.normal;
    }
  for (const Index side : sides) {
    const Plane& plane = solid.sides[static_cast<std::size_t>(side)].plane;
    for (int d = 0; d < 3; ++d)
      if (std::abs(plane.normal[d]) == 1.0) X[d] = plane.offset * plane.normal[d];
  }
  return X;
}

Vec3 along_sides(const Solid& solid, const std::vector<Index>& sides, Vec3 move) {
  const std::vector<Vec3> basis = normal_space(solid, sides);
  if (basis.size() == 3) return {};
  for (const Vec3& e : basis) move -= dot(move, e) * e;
  return move;
}

}  // namespace tessera
