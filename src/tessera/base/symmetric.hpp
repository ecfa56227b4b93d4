#pragma once

#include "tessera/base/mat3.hpp"

namespace tessera {

/// A symmetric second-order tensor, six numbers.
struct Symmetric3 {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;

  constexpr Symmetric3& operator+=(const Symmetric3& b) {
    xx += b.xx, xy += b.xy, xz += b.xz, yy += b.yy, yz += b.yz, zz += b.zz;
    return *this;
  }
  constexpr Symmetric3& operator-=(const Symmetric3& b) {
    xx -= b.xx, xy -= b.xy, xz -= b.xz, yy -= b.yy, yz -= b.yz, zz -= b.zz;
    return *this;
  }
  constexpr Symmetric3& operator*=(double s) {
    xx *= s, xy *= s, xz *= s, yy *= s, yz *= s, zz *= s;
    return *this;
  }

  friend constexpr bool operator==(const Symmetric3&, const Symmetric3&) = default;
};

constexpr Symmetric3 operator+(Symmetric3 a, const Symmetric3& b) { return a += b; }
constexpr Symmetric3 operator-(Symmetric3 a, const Symmetric3& b) { return a -= b; }
constexpr Symmetric3 operator*(double s, Symmetric3 a) { return a *= s; }

constexpr Vec3 operator*(const Symmetric3& a, const Vec3& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

/// v (x) v
constexpr Symmetric3 square(const Vec3& v) {
  return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
}

/// u (x) v + v (x) u
constexpr Symmetric3 symmetric_product(const Vec3& u, const Vec3& v) {
  return {2.0 * u.x * v.x, u.x * v.y + u.y * v.x, u.x * v.z + u.z * v.x,
          2.0 * u.y * v.y, u.y * v.z + u.z * v.y, 2.0 * u.z * v.z};
}

constexpr double trace(const Symmetric3& a) { return a.xx + a.yy + a.zz; }

/// The double contraction a : b = a_ij b_ij.
constexpr double contract(const Symmetric3& a, const Symmetric3& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}

constexpr Mat3 to_mat3(const Symmetric3& a) { return {{a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz}}; }

}  // namespace tessera
