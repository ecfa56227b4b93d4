#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tessera/base/mat3.hpp"
#include "tessera/laws/material.hpp"
#include "tessera/mechanics/forces.hpp"

namespace tessera::test {

inline double size_of(const Mat3& m) { return std::sqrt(contract(m, m)); }

/// Energy and derivatives of a bond as the papers write them, [D 7-11, 56-58].
struct ReferenceBond {
  Vec3 dU_dx, dU_dy;
};

inline ReferenceBond reference_bond(double Kn, double Kt, const Vec3& x, const Vec3& y) {
  const Vec3 n = normalized(x), u = x - y;
  const Vec3 u_n = dot(u, n) * n, u_t = u - u_n;
  return {Kn * u_n + Kt * u_t + ((Kn - Kt) * (dot(u, x) / norm2(x))) * u_t, -(Kn * u_n + Kt * u_t)};
}

/// Energy and derivatives of the bond between a particle and its constrained face, theory (14).
struct ReferenceBoundaryBond {
  double energy = 0.0;
  Vec3 dU_du;
  Mat3 dU_dF;  // through the normal, which turns with a face that is wholly held; at fixed u
};

/// `k` is 4 A / L, `u` the bond's displacement and `F` that of the particle.
inline ReferenceBoundaryBond reference_boundary_bond(const Material& m, double k, const Mat3& D, const Vec3& N,
                                                     const Vec3& u, const Mat3& F) {
  const double Kn = m.contact.normal * m.young * k, Kt = m.contact.tangential * m.shear_modulus() * k;
  const bool turns = size_of(identity() - D) < 1e-12;
  const Vec3 n = turns ? normalized(F * N) : N;
  const Vec3 u_n = dot(u, n) * n, u_t = u - u_n;
  const Vec3 s = D * (Kn * u_n + Kt * u_t);
  Mat3 slope;
  if (turns) slope = ((Kn - Kt) * dot(u, n) / norm(F * N)) * outer(u_t, N);
  return {0.5 * dot(u, s), s, slope};
}

/// P of [D 53], written with the inverse.
inline Mat3 reference_stress(const Material& m, const Mat3& F) {
  const double E = m.young, nu = m.poisson;
  const double lambda = nu * E / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = E / (2.0 * (1.0 + nu));
  return (lambda * std::log(determinant(F)) - mu) * transpose(inverse(F)) + mu * F;
}

/// A dense table of vectors or tensors with two particle indices.
template <class T>
class Table {
 public:
  explicit Table(std::size_t n) : n_(n), values_(n * n) {}
  T& operator()(std::size_t a, std::size_t b) { return values_[a * n_ + b]; }
  const T& operator()(std::size_t a, std::size_t b) const { return values_[a * n_ + b]; }

 private:
  std::size_t n_;
  std::vector<T> values_;
};

/// Positions of a smooth motion plus noise that no smooth motion has.
template <class Motion>
std::vector<Vec3> noisy(const std::vector<Vec3>& X, const Motion& motion, double noise) {
  std::mt19937_64 random(42);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  std::vector<Vec3> x;
  for (const Vec3& p : X) {
    const Vec3 d{uniform(random), uniform(random), uniform(random)};
    x.push_back(motion(p) + d);
  }
  return x;
}

/// The largest difference, relative to the largest reference vector.
inline double relative_difference(const std::vector<Vec3>& reference, const std::vector<Vec3>& value) {
  double largest = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    largest = std::max(largest, norm(reference[i]));
    const double difference = norm(value[i] - reference[i]);
    if (!std::isfinite(difference)) return difference;
    worst = std::max(worst, difference);
  }
  return worst / largest;
}

inline std::vector<Vec3> to_vectors(const Field<Double4>& f) {
  std::vector<Vec3> v;
  for (const Double4& d : f) v.push_back(to_vec3(d));
  return v;
}

}  // namespace tessera::test
