#include "tessera/geometry/surface_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/geometry/predicates.hpp"

namespace tessera {
namespace {

std::vector<Bounds> boxes_of(const TriangleSurface& surface) {
  std::vector<Bounds> boxes;
  boxes.reserve(surface.triangles.size());
  for (Index t = 0; t < surface.size(); ++t) boxes.push_back(bounds(surface, t));
  return boxes;
}

/// On which side of the line a -> b, seen from above, is X, moved by an infinitesimal e in x and e^2 in y? So it is on
/// no line, and opposite edges get opposite answers.
int side_of_line(const Vec3& a, const Vec3& b, const Vec3& X) {
  if (const int sign = orient2d(a, b, X, 2); sign != 0) return sign;
  if (a.y != b.y) return a.y > b.y ? 1 : -1;
  return b.x > a.x ? 1 : -1;
}

bool is_on(const std::array<Vec3, 3>& corners, const Vec3& X) {
  const auto& [a, b, c] = corners;
  return orient3d(a, b, c, X) == 0 && in_triangle(X, a, b, c);
}

}  // namespace

bool in_triangle(const Vec3& X, const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = orient2d(a, b, c, axis);
    if (turn == 0) continue;
    return orient2d(a, b, X, axis) * turn >= 0 && orient2d(b, c, X, axis) * turn >= 0 &&
           orient2d(c, a, X, axis) * turn >= 0;
  }
  return false;
}

// The regions of Voronoi of the triangle's features, one after the other (C. Ericson, Real-Time Collision Detection,
// 2005, section 5.1.5).
Vec3 nearest_on_triangle(const Vec3& X, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, aX = X - a, bX = X - b, cX = X - c;
  const double a1 = dot(ab, aX), a2 = dot(ac, aX);
  if (a1 <= 0 && a2 <= 0) return a;
  const double b1 = dot(ab, bX), b2 = dot(ac, bX);
  if (b1 >= 0 && b2 <= b1) return b;
  const double weight_c = a1 * b2 - b1 * a2;
  if (weight_c <= 0 && a1 >= 0 && b1 <= 0) return a + (a1 / (a1 - b1)) * ab;
  const double c1 = dot(ab, cX), c2 = dot(ac, cX);
  if (c2 >= 0 && c1 <= c2) return c;
  const double weight_b = c1 * a2 - a1 * c2;
  if (weight_b <= 0 && a2 >= 0 && c2 <= 0) return a + (a2 / (a2 - c2)) * ac;
  const double weight_a = b1 * c2 - c1 * b2;
  if (weight_a <= 0 && b2 >= b1 && c1 >= c2) return b + ((b2 - b1) / ((b2 - b1) + (c1 - c2))) * (c - b);
  const double sum = weight_a + weight_b + weight_c;
  return a + (weight_b / sum) * ab + (weight_c / sum) * ac;
}

SurfaceIndex::SurfaceIndex(const TriangleSurface& surface) : surface_(surface), tree_(boxes_of(surface)) {}

void SurfaceIndex::triangles_near(const Bounds& box, std::vector<Index>& found) const {
  found.clear();
  for_each_near(box, [&](Index t) { found.push_back(t); });
  std::sort(found.begin(), found.end());
}

int SurfaceIndex::crossing(const std::array<Vec3, 3>& corners, const Vec3& X) {
  const auto& [a, b, c] = corners;
  const int turn = orient2d(a, b, c, 2);
  if (turn == 0) return 0;  // seen from above it is a line, beside which the ray passes
  if (side_of_line(a, b, X) != turn || side_of_line(b, c, X) != turn || side_of_line(c, a, X) != turn) return 0;
  return orient3d(a, b, c, X) * turn < 0 ? turn : 0;
}

Location SurfaceIndex::location(const Vec3& X) const {
  bool on_surface = false;
  tree_.visit([&](const Bounds& box) { return !on_surface && box.contains(X); },
              [&](Index t) { on_surface = on_surface || is_on(surface_.corners(t), X); });
  if (on_surface) return Location::on_surface;
  return winding(X) != 0 ? Location::inside : Location::outside;
}

NearestPoint SurfaceIndex::nearest(const Vec3& X) const {
  const auto [t, distance2] = nearest_below(std::numeric_limits<double>::infinity(), X);
  if (t < 0) return {-1, X, std::numeric_limits<double>::infinity()};
  const auto [a, b, c] = surface_.corners(t);
  return {t, nearest_on_triangle(X, a, b, c), std::sqrt(distance2)};
}

bool SurfaceIndex::is_nearer_than(double distance, const Vec3& X) const {
  return nearest_below(distance * distance, X).first >= 0;
}

std::pair<Index, double> SurfaceIndex::nearest_below(double distance2, const Vec3& X) const {
  return tree_.minimum([&](const Bounds& box) { return box.distance2(X); },
                       [&](Index t) {
                         const auto [a, b, c] = surface_.corners(t);
                         return norm2(X - nearest_on_triangle(X, a, b, c));
                       },
                       distance2);
}

}  // namespace tessera
