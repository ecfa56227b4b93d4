#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/small_bodies.hpp"
#include "tessera/dynamics/time_step.hpp"

namespace tessera::test {

inline std::vector<Vec3> resting_walls(const System& s) {
  return walls_of(s, [](const Vec3& X) { return X; });
}

/// M^-1/2 K M^-1/2 of the forces about the reference, column by column by central differences; held directions taken
/// out.
inline Eigen::MatrixXd dense_stiffness(const System& s) {
  const auto n = static_cast<Eigen::Index>(3 * s.particles());
  const std::vector<Vec3> walls = resting_walls(s);
  Forces forces(s);
  State state = reference_state(s);
  const double h = 1e-6;
  const auto force_at = [&](Eigen::Index j, double step) {
    Eigen::VectorXd f(n);
    State moved = state;
    moved.x[static_cast<std::size_t>(j / 3)][static_cast<int>(j % 3)] += step;
    forces.evaluate(moved, {walls, {}, {}}, 0.0);
    for (Eigen::Index i = 0; i < n; ++i)
      f(i) = forces.total()[static_cast<std::size_t>(i / 3)][static_cast<int>(i % 3)];
    return f;
  };
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index j = 0; j < n; ++j) K.col(j) = -(force_at(j, h) - force_at(j, -h)) / (2.0 * h);
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(n, n);
  for (const ParticleConstraint& c : s.d.constraints)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) free(3 * c.particle + i, 3 * c.particle + j) -= c.D(i, j);
  Eigen::VectorXd weight(n);
  for (Eigen::Index i = 0; i < n; ++i) weight(i) = 1.0 / std::sqrt(s.mass[static_cast<std::size_t>(i / 3)]);
  return free * weight.asDiagonal() * K * weight.asDiagonal() * free;
}

/// The largest frequency by a dense eigenvalue solver that does not assume symmetry.
inline double largest_frequency(const Eigen::MatrixXd& K) {
  const Eigen::VectorXcd values = K.eigenvalues();
  double largest = 0.0;
  for (Eigen::Index i = 0; i < values.size(); ++i) largest = std::max(largest, std::abs(values(i)));
  return std::sqrt(largest);
}

}  // namespace tessera::test
