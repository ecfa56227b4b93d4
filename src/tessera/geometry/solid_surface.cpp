#include "tessera/geometry/solid_surface.hpp"

#include <cmath>

#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_reader.hpp"

namespace tessera {
namespace {

/// The axis that a unit vector is exactly parallel to, -1 for none.
int axis_of(const Vec3& normal) {
  for (int d = 0; d < 3; ++d)
    if (std::abs(normal[d]) == 1 && normal[(d + 1) % 3] == 0 && normal[(d + 2) % 3] == 0) return d;
  return -1;
}

/// X, which is on the plane to round-off; exactly so when the plane is axis-parallel.
Vec3 put_on(const Plane& plane, Vec3 X) {
  if (const int d = axis_of(plane.normal); d >= 0) X[d] = plane.normal[d] * plane.offset;
  return X;
}

/// A square in the plane, counter-clockwise seen from its outside, that holds all of the plane within the box.
std::vector<Vec3> large_square(const Plane& plane, const Vec3& lower, const Vec3& upper) {
  const Vec3 middle = 0.5 * (lower + upper), n = plane.normal;
  const double size = 2 * norm(upper - lower);
  const Vec3 center = middle - plane.height(middle) * n;
  Vec3 away;
  away[std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? 0
                                                                        : (std::abs(n.y) <= std::abs(n.z) ? 1 : 2)] = 1;
  const Vec3 u = size * normalized(cross(away, n)), v = cross(n, u);
  return {put_on(plane, center - u - v), put_on(plane, center + u - v), put_on(plane, center + u + v),
          put_on(plane, center - u + v)};
}

/// What of the polygon is on the inner side of a plane (I. E. Sutherland, G. W. Hodgman, Commun. ACM 17, 1974).
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Plane& plane) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double height_a = plane.height(a), height_b = plane.height(b);
    if (height_a <= 0) kept.push_back(a);
    if ((height_a < 0 && height_b > 0) || (height_a > 0 && height_b < 0))
      kept.push_back(put_on(plane, a + (height_a / (height_a - height_b)) * (b - a)));
  }
  return kept;
}

std::vector<Vec3> face_of(const ConvexPiece& piece, std::size_t wall) {
  std::vector<Vec3> face = large_square(piece.walls[wall].plane, piece.lower, piece.upper);
  for (std::size_t w = 0; w < piece.walls.size(); ++w)
    if (w != wall) face = clipped(face, piece.walls[w].plane);
  return face;
}

void add_face(const std::vector<Vec3>& face, SideSummary& side) {
  for (const Vec3& X : face) side.box.include(X);
  for (std::size_t i = 2; i < face.size(); ++i) {
    const double area = 0.5 * norm(cross(face[i - 1] - face[0], face[i] - face[0]));
    ++side.triangles;
    side.area += area;
    side.center += (area / 3.0) * (face[0] + face[i - 1] + face[i]);
  }
}

}  // namespace

std::vector<SideSummary> summarize_sides(const Solid& solid) {
  std::vector<SideSummary> sides;
  for (const Side& side : solid.sides) sides.push_back({side.names[0], 0, 0.0, side.plane.normal, {}, {}});
  for (const ConvexPiece& piece : solid.pieces)
    for (std::size_t w = 0; w < piece.walls.size(); ++w)
      if (const Index side = piece.walls[w].side; side >= 0)
        add_face(face_of(piece, w), sides[static_cast<std::size_t>(side)]);
  for (SideSummary& side : sides)
    if (side.area > 0.0) side.center = side.center / side.area;
  return sides;
}

TriangleSurface surface_of(const Solid& solid) {
  FileSurfaceBuilder builder("the shape", PlaceUnit::line);
  std::vector<Index> corners;
  for (const ConvexPiece& piece : solid.pieces)
    for (std::size_t w = 0; w < piece.walls.size(); ++w) {
      const Index side = piece.walls[w].side;
      if (side < 0) continue;
      corners.clear();
      for (const Vec3& X : face_of(piece, w)) {
        corners.push_back(builder.vertices());
        builder.add_vertex(X);
      }
      builder.add_polygon(corners, builder.side(solid.sides[static_cast<std::size_t>(side)].names[0]), 0);
    }
  builder.file().place.clear();
  return check_surface(std::move(builder.file())).surface;
}

}  // namespace tessera
