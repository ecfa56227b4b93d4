#include "tessera/discretization/stencil.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace tessera {
namespace {

std::vector<Vec3> cloud(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vec3> y;
  while (y.size() < n) {
    const Vec3 p{uniform(random), uniform(random), uniform(random)};
    if (norm(p) > 0.2) y.push_back(p);
  }
  return y;
}

enum class Kind { balanced, spanning };

struct Weights {
  std::vector<double> w;
  StencilFit fit;
};

Weights weights(Kind kind, const std::vector<Vec3>& y, const Vec3& target) {
  Weights result{std::vector<double>(y.size()), {}};
  result.fit = kind == Kind::balanced ? balanced_weights(y, target, result.w) : spanning_weights(y, target, result.w);
  return result;
}

/// Distance of w_c r_c^2 from the functions lambda . y_c (+ lambda_0), which make a constrained minimum of
/// sum w_c^2 r_c^2.
double distance_from_stationary(Kind kind, const std::vector<Vec3>& y, const std::vector<double>& w) {
  const auto n = static_cast<Eigen::Index>(y.size());
  Eigen::MatrixXd functions = Eigen::MatrixXd::Zero(n, 4);
  Eigen::VectorXd values(n);
  for (Eigen::Index c = 0; c < n; ++c) {
    const Vec3& p = y[static_cast<std::size_t>(c)];
    functions.row(c) << p.x, p.y, p.z, kind == Kind::balanced ? 1.0 : 0.0;
    values(c) = w[static_cast<std::size_t>(c)] * norm2(p);
  }
  const Eigen::VectorXd multipliers = functions.completeOrthogonalDecomposition().solve(values);
  return (functions * multipliers - values).norm();
}

TEST(Stencil, MeetsItsConditionsWithTheLeastWeights) {
  const Vec3 target{0.1, -0.2, 0.05};
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (Kind kind : {Kind::balanced, Kind::spanning}) {
      const std::vector<Vec3> y = cloud(9, seed);
      const Weights found = weights(kind, y, target);
      Vec3 moment;
      double sum = 0.0, cost = 0.0;
      for (std::size_t c = 0; c < y.size(); ++c) {
        moment += found.w[c] * y[c];
        sum += found.w[c];
        cost += found.w[c] * found.w[c] * norm2(y[c]);
      }
      EXPECT_LT(norm(moment - target), 1e-15);
      EXPECT_LT(norm(found.fit.residual), 1e-15);
      EXPECT_LT(kind == Kind::balanced ? std::abs(sum) : 0.0, 1e-15);
      EXPECT_NEAR(found.fit.amplification, std::sqrt(cost) / norm(target), 1e-12);
      EXPECT_LT(distance_from_stationary(kind, y, found.w), 1e-14);
    }
}

/// Points in a plane cannot reach out of it; what they can reach they do.
TEST(Stencil, LeavesMissingDirectionsToTheResidual) {
  std::vector<Vec3> y = cloud(8, 3);
  for (Vec3& p : y) p.z = 0.0;
  for (Kind kind : {Kind::balanced, Kind::spanning})
    EXPECT_LT(norm(weights(kind, y, {0.1, -0.2, 0.3}).fit.residual - Vec3{0, 0, 0.3}), 1e-14);
}

/// The unit of length does not matter.
TEST(Stencil, ScalesWithLength) {
  const std::vector<Vec3> y = cloud(9, 5);
  std::vector<Vec3> tiny = y;
  for (Vec3& p : tiny) p *= 1e-6;
  const Weights large = weights(Kind::balanced, y, {0.1, 0.2, 0.3});
  const Weights small = weights(Kind::balanced, tiny, {1e-7, 2e-7, 3e-7});
  for (std::size_t c = 0; c < y.size(); ++c) EXPECT_NEAR(large.w[c], small.w[c], 1e-13);
}

}  // namespace
}  // namespace tessera
