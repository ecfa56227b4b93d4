#pragma once

#include <cmath>

#include "tessera/base/mat3.hpp"

namespace tessera {

/// Eigenvalues of a symmetric tensor, in no order, and the orthonormal eigenvectors that belong to them.
struct PrincipalAxes {
  Vec3 values;
  std::array<Vec3, 3> vectors;
};

namespace detail {

/// Turns rows p and q of V and of the symmetric S so that S(p, q) vanishes.
inline void rotate_away(Mat3& S, Mat3& V, int p, int q) {
  if (S(p, q) == 0.0) return;
  const double theta = 0.5 * (S(q, q) - S(p, p)) / S(p, q);
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  const int r = 3 - p - q;
  const double S_pq = S(p, q), S_rp = S(r, p), S_rq = S(r, q);
  S(p, p) -= t * S_pq;
  S(q, q) += t * S_pq;
  S(p, q) = S(q, p) = 0.0;
  S(r, p) = S(p, r) = c * S_rp - s * S_rq;
  S(r, q) = S(q, r) = s * S_rp + c * S_rq;
  for (int i = 0; i < 3; ++i) {
    const double V_p = V(p, i), V_q = V(q, i);
    V(p, i) = c * V_p - s * V_q;
    V(q, i) = s * V_p + c * V_q;
  }
}

}  // namespace detail

/// Eigenvalues and eigenvectors by Jacobi's rotations, to round-off of the largest eigenvalue, equal ones included.
inline PrincipalAxes principal_axes(Mat3 S) {
  constexpr int sweeps = 12;  // convergence is quadratic: five are usual
  constexpr double negligible = 1e-36;
  Mat3 V = identity();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const double rest = S(0, 1) * S(0, 1) + S(0, 2) * S(0, 2) + S(1, 2) * S(1, 2);
    if (rest <= negligible * (S(0, 0) * S(0, 0) + S(1, 1) * S(1, 1) + S(2, 2) * S(2, 2))) break;
    detail::rotate_away(S, V, 0, 1);
    detail::rotate_away(S, V, 0, 2);
    detail::rotate_away(S, V, 1, 2);
  }
  return {{S(0, 0), S(1, 1), S(2, 2)},
          {Vec3{V(0, 0), V(0, 1), V(0, 2)}, Vec3{V(1, 0), V(1, 1), V(1, 2)}, Vec3{V(2, 0), V(2, 1), V(2, 2)}}};
}

/// The symmetric tensor with these eigenvalues and eigenvectors.
inline Mat3 from_axes(const Vec3& values, const std::array<Vec3, 3>& vectors) {
  Mat3 S;
  for (int k = 0; k < 3; ++k)
    S += values[k] * outer(vectors[static_cast<std::size_t>(k)], vectors[static_cast<std::size_t>(k)]);
  return S;
}

}  // namespace tessera
