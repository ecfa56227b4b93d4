#include "tessera/geometry/surface_transform.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace tessera {
namespace {

/// Cosine and sine of an angle in degrees, exact for quarter turns.
std::pair<double, double> cosine_and_sine(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0) return {1, 0};
  if (std::abs(turn) == 180) return {-1, 0};
  if (std::abs(turn) == 90) return {0, turn > 0 ? 1 : -1};
  const double angle = turn * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

TriangleSurface transformed(TriangleSurface surface, const Mat3& A, const Vec3& shift) {
  for (Vec3& X : surface.vertices) X = A * X + shift;
  if (determinant(A) < 0)
    for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

// The formula of Rodrigues: c I + s [n]x + (1 - c) n (x) n.
Mat3 rotation(const Vec3& axis, double angle) {
  const auto [c, s] = cosine_and_sine(angle);
  const Vec3 n = normalized(axis);
  const Mat3 across{{0, -n.z, n.y, n.z, 0, -n.x, -n.y, n.x, 0}};
  return c * identity() + s * across + (1 - c) * outer(n, n);
}

Mat3 frame_along(const Vec3& axis) {
  const Vec3 w = normalized(axis);
  int across = 0;  // the coordinate axis that is most nearly across
  for (int d = 1; d < 3; ++d)
    if (std::abs(w[d]) < std::abs(w[across])) across = d;
  Vec3 e;
  e[across] = 1;
  const Vec3 u = normalized(e - w[across] * w), v = cross(w, u);
  return {{u.x, v.x, w.x, u.y, v.y, w.y, u.z, v.z, w.z}};
}

}  // namespace tessera
