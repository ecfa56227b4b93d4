#pragma once

#include "tessera/base/field.hpp"
#include "tessera/base/lanes.hpp"
#include "tessera/base/mat3.hpp"

namespace tessera {

/// A tensor by columns, so that T B = column0 B_x + column1 B_y + column2 B_z takes three multiply-adds.
struct Columns {
  Double4 c0, c1, c2;
};

/// The same in the arrays that are streamed: nine numbers, column by column.
struct Tensor {
  double m[9];
};

/// What F_a lacks at three stress points of a cell, or derivatives of its energy with respect to three tensors.
struct ThreeTensors {
  Columns k[3];
};

inline Double4 to_kernel(const Vec3& v) { return Double4{v.x, v.y, v.z, 0.0}; }
inline Vec3 to_vec3(const Double4& v) { return {v[0], v[1], v[2]}; }

inline Columns to_kernel(const Mat3& m) {
  return {Double4{m(0, 0), m(1, 0), m(2, 0), 0.0}, Double4{m(0, 1), m(1, 1), m(2, 1), 0.0},
          Double4{m(0, 2), m(1, 2), m(2, 2), 0.0}};
}
inline Columns to_kernel(const Tensor& t) {
  return {Double4{t.m[0], t.m[1], t.m[2], 0.0}, Double4{t.m[3], t.m[4], t.m[5], 0.0},
          Double4{t.m[6], t.m[7], t.m[8], 0.0}};
}
inline Tensor to_tensor(const Columns& t) {
  return {{t.c0[0], t.c0[1], t.c0[2], t.c1[0], t.c1[1], t.c1[2], t.c2[0], t.c2[1], t.c2[2]}};
}
inline Tensor to_tensor(const Mat3& m) {
  return {{m(0, 0), m(1, 0), m(2, 0), m(0, 1), m(1, 1), m(2, 1), m(0, 2), m(1, 2), m(2, 2)}};
}
inline Mat3 to_mat3(const Columns& t) {
  return {{t.c0[0], t.c1[0], t.c2[0], t.c0[1], t.c1[1], t.c2[1], t.c0[2], t.c1[2], t.c2[2]}};
}
inline Mat3 to_mat3(const Tensor& t) {
  return {{t.m[0], t.m[3], t.m[6], t.m[1], t.m[4], t.m[7], t.m[2], t.m[5], t.m[8]}};
}

inline double dot3(const Double4& a, const Double4& b) {
  const Double4 p = a * b;
  return p[0] + p[1] + p[2];
}

/// T B
inline Double4 apply(const Columns& T, const Vec3& B) { return T.c0 * B.x + T.c1 * B.y + T.c2 * B.z; }

/// T += v (x) B
inline void add_outer(Columns& T, const Double4& v, const Vec3& B) {
  T.c0 += v * B.x;
  T.c1 += v * B.y;
  T.c2 += v * B.z;
}

inline Columns operator+(const Columns& a, const Columns& b) { return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2}; }
inline Columns operator-(const Columns& a, const Columns& b) { return {a.c0 - b.c0, a.c1 - b.c1, a.c2 - b.c2}; }
inline Columns operator*(double s, const Columns& a) { return {s * a.c0, s * a.c1, s * a.c2}; }

}  // namespace tessera
