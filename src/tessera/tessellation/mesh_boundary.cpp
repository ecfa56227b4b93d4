#include "tessera/tessellation/mesh_boundary.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

bool lies_in(const Plane& plane, const Triangle& triangle, std::span<const Vec3> points, double tolerance) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](Index v) { return std::abs(plane.height(points[static_cast<std::size_t>(v)])) <= tolerance; });
}

bool holds(const ConvexPiece& piece, const Vec3& X, double tolerance) {
  return std::all_of(piece.walls.begin(), piece.walls.end(),
                     [&](const ConvexPiece::Wall& wall) { return wall.plane.height(X) <= tolerance; });
}

bool is_wall_at(const Solid& solid, Index side, const Vec3& X, double tolerance) {
  for (const ConvexPiece& piece : solid.pieces)
    for (const ConvexPiece::Wall& wall : piece.walls)
      if (wall.side == side && std::abs(wall.plane.height(X)) <= tolerance && holds(piece, X, tolerance)) return true;
  return false;
}

}  // namespace

std::vector<Triangle> outer_faces(std::span<const Tetrahedron> tetrahedra) {
  const std::vector<TetrahedronFace> faces = sorted_faces(tetrahedra);
  std::vector<Triangle> outer;
  for_each_face(faces, [&](std::span<const TetrahedronFace> uses) {
    if (uses.size() == 1) outer.push_back(uses[0].vertices);
  });
  std::sort(outer.begin(), outer.end());
  return outer;
}

Index side_of(const Triangle& triangle, std::span<const Vec3> points, const Solid& solid, double tolerance) {
  const Vec3 area = area_vector(triangle, points);
  const Vec3 middle = centroid(triangle, points);
  for (std::size_t i = 0; i < solid.sides.size(); ++i) {
    const Plane& plane = solid.sides[i].plane;
    if (dot(area, plane.normal) <= 0.0 || !lies_in(plane, triangle, points, tolerance)) continue;
    if (is_wall_at(solid, static_cast<Index>(i), middle, tolerance)) return static_cast<Index>(i);
  }
  return -1;
}

}  // namespace tessera
