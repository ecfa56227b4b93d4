#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"

namespace tessera::test {

/// Weights of particles in the second derivatives xx, xy, xz, yy, yz, zz at another one: of all that are exact for
/// quadratic functions those with the least sum of squares, one set of six for each branch between them. Empty where
/// none are exact.
inline std::vector<std::array<double, 6>> quadratic_weights(std::span<const Vec3> branches) {
  double longest = 0.0;
  for (const Vec3& X : branches) longest = std::max(longest, norm(X));
  Eigen::MatrixXd functions(9, static_cast<Eigen::Index>(branches.size()));
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const Vec3 c = (1.0 / longest) * branches[b];
    functions.col(static_cast<Eigen::Index>(b)) << c.x, c.y, c.z, 0.5 * c.x * c.x, c.x * c.y, c.x * c.z,
        0.5 * c.y * c.y, c.y * c.z, 0.5 * c.z * c.z;
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-9);
  solver.compute(functions);
  if (solver.rank() < 9) return {};
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(9, 6);
  wanted.bottomRows<6>().setIdentity();
  const Eigen::MatrixXd least = solver.solve(wanted) / (longest * longest);
  std::vector<std::array<double, 6>> W(branches.size());
  for (std::size_t b = 0; b < branches.size(); ++b)
    for (std::size_t r = 0; r < 6; ++r) W[b][r] = least(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(r));
  return W;
}

}  // namespace tessera::test
