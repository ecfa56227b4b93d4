#pragma once

#include <cmath>
#include <limits>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// Coordinates must be smaller than this in size, and so finite, for all that follows.
inline constexpr double kLargestCoordinate = 1e50;

inline bool is_usable(const Vec3& X) {
  return std::abs(X.x) < kLargestCoordinate && std::abs(X.y) < kLargestCoordinate && std::abs(X.z) < kLargestCoordinate;
}

/// Signs of determinants of the given floating-point numbers, never wrong, whatever round-off does: a filter decides
/// the plain cases, CGAL's exact kernel the others. All may be called by many threads at once.
namespace exact {
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis);
int side_of_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);
}  // namespace exact

namespace detail {
/// Relative error bounds of the filters for round-off of 2^-53 (J. R. Shewchuk, Adaptive precision floating-point
/// arithmetic, Discrete Comput. Geom. 18, 1997); below the smallest magnitude underflow could spoil them.
inline constexpr double orient3d_bound = 7.78e-16;
inline constexpr double orient2d_bound = 3.34e-16;
inline constexpr double sphere_bound = 8.1;  // in units of epsilon, whose half is that round-off
inline constexpr double least_magnitude = 1e-200;
}  // namespace detail

/// The sign of det(b - a, c - a, d - a): +1 when d is on the side of the plane through a, b, c from which these run
/// counter-clockwise, -1 when it is on the other side, 0 when all four are in one plane.
///
///        d        +1 for a, b, c as drawn, seen from d
///      c .
///     / \   .
///    a - b
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p = a - d, q = b - d, r = c - d;
  const double qxry = q.x * r.y, rxqy = r.x * q.y, rxpy = r.x * p.y, pxry = p.x * r.y, pxqy = p.x * q.y,
               qxpy = q.x * p.y;
  const double minus_det = p.z * (qxry - rxqy) + q.z * (rxpy - pxry) + r.z * (pxqy - qxpy);
  const double magnitude = std::abs(p.z) * (std::abs(qxry) + std::abs(rxqy)) +
                           std::abs(q.z) * (std::abs(rxpy) + std::abs(pxry)) +
                           std::abs(r.z) * (std::abs(pxqy) + std::abs(qxpy));
  if (magnitude > detail::least_magnitude) {
    if (minus_det > detail::orient3d_bound * magnitude) return -1;
    if (-minus_det > detail::orient3d_bound * magnitude) return 1;
  }
  for (int axis = 0; axis < 3; ++axis)  // differences are zero exactly when the numbers are equal
    if (p[axis] == 0 && q[axis] == 0 && r[axis] == 0) return 0;
  return exact::orient3d(a, b, c, d);
}

/// The sign of component `axis` of (b - a) x (c - a): +1 when a, b, c run counter-clockwise, seen against that axis
/// (from its positive end).
inline int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double left = (a[i] - c[i]) * (b[j] - c[j]), right = (a[j] - c[j]) * (b[i] - c[i]);
  const double det = left - right, magnitude = std::abs(left) + std::abs(right);
  if (magnitude > detail::least_magnitude) {
    if (det > detail::orient2d_bound * magnitude) return 1;
    if (-det > detail::orient2d_bound * magnitude) return -1;
  }
  if ((a[i] == c[i] && b[i] == c[i]) || (a[j] == c[j] && b[j] == c[j])) return 0;
  return exact::orient2d(a, b, c, axis);
}

/// Are the three points on one line? A triangle for which this is so has no area.
inline bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0 && orient2d(a, b, c, 2) == 0;
}

namespace detail {

/// The answer of side_of_sphere if arithmetic with `Real` numbers can tell, else 0.
template <class Real>
int filtered_side_of_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  struct Vector {
    Real x, y, z;
  };
  const auto from_e = [&](const Vec3& p) {
    return Vector{static_cast<Real>(p.x) - static_cast<Real>(e.x), static_cast<Real>(p.y) - static_cast<Real>(e.y),
                  static_cast<Real>(p.z) - static_cast<Real>(e.z)};
  };
  const auto square = [](const Vector& u) { return u.x * u.x + u.y * u.y + u.z * u.z; };
  const auto minor = [](const Vector& u, const Vector& v) { return u.x * v.y - v.x * u.y; };
  const auto size = [](const Vector& u, const Vector& v) { return std::abs(u.x * v.y) + std::abs(v.x * u.y); };
  const Vector p = from_e(a), q = from_e(b), r = from_e(c), s = from_e(d);
  const Real P = square(p), Q = square(q), R = square(r), S = square(s);
  const Real pq = minor(p, q), qr = minor(q, r), rs = minor(r, s), sp = minor(s, p), pr = minor(p, r), qs = minor(q, s);
  const Real det = (S * (p.z * qr - q.z * pr + r.z * pq) - R * (s.z * pq + p.z * qs + q.z * sp)) +
                   (Q * (r.z * sp + s.z * pr + p.z * rs) - P * (q.z * rs - r.z * qs + s.z * qr));
  const Real PQ = size(p, q), QR = size(q, r), RS = size(r, s), SP = size(s, p), PR = size(p, r), QS = size(q, s);
  const Real pz = std::abs(p.z), qz = std::abs(q.z), rz = std::abs(r.z), sz = std::abs(s.z);
  const Real magnitude = S * (pz * QR + qz * PR + rz * PQ) + R * (sz * PQ + pz * QS + qz * SP) +
                         Q * (rz * SP + sz * PR + pz * RS) + P * (qz * RS + rz * QS + sz * QR);
  const Real bound = static_cast<Real>(sphere_bound) * std::numeric_limits<Real>::epsilon() * magnitude;
  if (magnitude > static_cast<Real>(least_magnitude)) {
    if (det > bound) return -1;
    if (-det > bound) return 1;
  }
  return 0;
}

}  // namespace detail

/// Where e is with respect to the sphere through a, b, c, d: +1 inside, -1 outside, 0 on it, provided that
/// orient3d(a, b, c, d) is +1; the other way round when it is -1.
inline int side_of_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  if (const int side = detail::filtered_side_of_sphere<double>(a, b, c, d, e); side != 0) return side;
  // Lattices whose spacing is not a binary fraction miss their spheres by a few units in the last place.
  if (const int side = detail::filtered_side_of_sphere<long double>(a, b, c, d, e); side != 0) return side;
  return exact::side_of_sphere(a, b, c, d, e);
}

struct WeightedPoint {
  Vec3 X;
  double weight = 0.0;  // the square of its radius
};

/// The same for the sphere orthogonal to the spheres of four weighted points: +1 where the power of e to it is
/// negative, so that e has a part of the space that a, b, c, d would else share a corner in. Not for points in one
/// plane. Exact.
int side_of_power_sphere(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, const WeightedPoint& d,
                         const WeightedPoint& e);

/// The sign of component `axis` of (b - a) x (d - c). Slow: for ties.
int cross_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int axis);

/// The part of the way from p to q at which the plane through a, b, c is crossed, to the last digit: exact for all but
/// the result, so that it is between 0 and 1 when p and q are on different sides. These must not be equally high above
/// the plane. Slow: for segments that are nearly parallel to the plane.
double crossing_fraction(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, const Vec3& q);

}  // namespace tessera
