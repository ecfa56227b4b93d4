#include "tessera/tessellation/surface_shifted.hpp"

#include "tessera/geometry/predicates.hpp"

namespace tessera::shifted {
namespace {

/// The sign of (b - a) x (c - a) . (e, e^2, e^3): that of the first component that is not zero.
int leading_sign(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis)
    if (const int sign = orient2d(a, b, c, axis); sign != 0) return sign;
  return 0;
}

}  // namespace

int above_triangle(const Vec3& u0, const Vec3& u1, const Vec3& u2, const Vec3& v) {
  const int sign = orient3d(u0, u1, u2, v);
  return sign != 0 ? sign : leading_sign(u0, u1, u2);
}

int above_face(const Vec3& v0, const Vec3& v1, const Vec3& v2, const Vec3& u) {
  const int sign = orient3d(v0, v1, v2, u);
  return sign != 0 ? sign : -leading_sign(v0, v1, v2);
}

int passes(const Vec3& v0, const Vec3& v1, const Vec3& u0, const Vec3& u1) {
  if (const int sign = orient3d(v0, v1, u0, u1); sign != 0) return sign;
  for (int axis = 0; axis < 3; ++axis)
    if (const int sign = cross_sign(v0, v1, u0, u1, axis); sign != 0) return sign;
  return 0;
}

int passes_ray(const Vec3& v0, const Vec3& u, const Vec3& v1, const Vec3& v2) {
  const int sign = orient3d(v0, u, v1, v2);
  return sign != 0 ? sign : -leading_sign(v0, v1, v2);
}

}  // namespace tessera::shifted
