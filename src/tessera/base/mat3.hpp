#pragma once

#include <array>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// A second-order tensor, stored row by row.
struct Mat3 {
  std::array<double, 9> m{};

  constexpr double& operator()(int i, int j) { return m[static_cast<std::size_t>(3 * i + j)]; }
  constexpr double operator()(int i, int j) const { return m[static_cast<std::size_t>(3 * i + j)]; }

  constexpr Mat3& operator+=(const Mat3& b) {
    for (std::size_t i = 0; i < 9; ++i) m[i] += b.m[i];
    return *this;
  }
  constexpr Mat3& operator-=(const Mat3& b) {
    for (std::size_t i = 0; i < 9; ++i) m[i] -= b.m[i];
    return *this;
  }
  constexpr Mat3& operator*=(double s) {
    for (double& v : m) v *= s;
    return *this;
  }

  friend constexpr bool operator==(const Mat3&, const Mat3&) = default;
};

constexpr Mat3 diagonal(double a, double b, double c) { return {{a, 0, 0, 0, b, 0, 0, 0, c}}; }
constexpr Mat3 identity() { return diagonal(1, 1, 1); }

constexpr Mat3 operator+(Mat3 a, const Mat3& b) { return a += b; }
constexpr Mat3 operator-(Mat3 a, const Mat3& b) { return a -= b; }
constexpr Mat3 operator*(double s, Mat3 a) { return a *= s; }

constexpr Vec3 operator*(const Mat3& a, const Vec3& v) {
  return {a(0, 0) * v.x + a(0, 1) * v.y + a(0, 2) * v.z, a(1, 0) * v.x + a(1, 1) * v.y + a(1, 2) * v.z,
          a(2, 0) * v.x + a(2, 1) * v.y + a(2, 2) * v.z};
}

constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
  Mat3 c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}

/// The dyadic product a (x) b.
constexpr Mat3 outer(const Vec3& a, const Vec3& b) {
  return {{a.x * b.x, a.x * b.y, a.x * b.z, a.y * b.x, a.y * b.y, a.y * b.z, a.z * b.x, a.z * b.y, a.z * b.z}};
}

constexpr Mat3 transpose(const Mat3& a) {
  return {{a(0, 0), a(1, 0), a(2, 0), a(0, 1), a(1, 1), a(2, 1), a(0, 2), a(1, 2), a(2, 2)}};
}
constexpr double trace(const Mat3& a) { return a(0, 0) + a(1, 1) + a(2, 2); }

/// The double contraction a : b = a_ij b_ij.
constexpr double contract(const Mat3& a, const Mat3& b) {
  double s = 0.0;
  for (std::size_t i = 0; i < 9; ++i) s += a.m[i] * b.m[i];
  return s;
}

constexpr double determinant(const Mat3& a) {
  return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) - a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
         a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}

/// The cofactor matrix, det(a) a^-T.
constexpr Mat3 cofactor(const Mat3& a) {
  return {{a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1), a(1, 2) * a(2, 0) - a(1, 0) * a(2, 2),
           a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0), a(0, 2) * a(2, 1) - a(0, 1) * a(2, 2),
           a(0, 0) * a(2, 2) - a(0, 2) * a(2, 0), a(0, 1) * a(2, 0) - a(0, 0) * a(2, 1),
           a(0, 1) * a(1, 2) - a(0, 2) * a(1, 1), a(0, 2) * a(1, 0) - a(0, 0) * a(1, 2),
           a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0)}};
}

/// The inverse; the caller knows that det(a) is not zero.
constexpr Mat3 inverse(const Mat3& a) { return (1.0 / determinant(a)) * transpose(cofactor(a)); }

}  // namespace tessera
