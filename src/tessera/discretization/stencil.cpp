#include "tessera/discretization/stencil.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

// Eigenvalues below this fraction of the largest belong to directions in which the points do not extend.
constexpr double rank_threshold = 1e-9;

/// Minimises sum w^2 r^2 subject to sum_c w_c g_c = target for the N-vectors g_c of the constraints:
/// w_c = g_c . M^+ target / r_c^2 with M = sum g g^T / r^2. Two rounds of refinement bring the residual to round-off.
template <int N, class Constraint>
Eigen::Matrix<double, N, 1> solve(std::span<const Vec3> y, double scale, const Constraint& constraint,
                                  const Eigen::Matrix<double, N, 1>& target, std::vector<double>& w) {
  using Vector = Eigen::Matrix<double, N, 1>;
  Eigen::Matrix<double, N, N> M = Eigen::Matrix<double, N, N>::Zero();
  for (const Vec3& p : y) {
    const Vector g = constraint(p);
    M += g * g.transpose() * (scale * scale / norm2(p));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(M);
  const double cut = rank_threshold * eigen.eigenvalues()(N - 1);
  Vector inverse_values;
  for (int i = 0; i < N; ++i) inverse_values(i) = eigen.eigenvalues()(i) > cut ? 1.0 / eigen.eigenvalues()(i) : 0.0;

  w.assign(y.size(), 0.0);
  Vector residual = target;
  for (int round = 0; round < 3; ++round) {
    const Vector multiplier =
        eigen.eigenvectors() * inverse_values.cwiseProduct(eigen.eigenvectors().transpose() * residual);
    residual = target;
    for (std::size_t c = 0; c < y.size(); ++c) {
      const Vector g = constraint(y[c]);
      w[c] += g.dot(multiplier) * scale * scale / norm2(y[c]);
      residual -= w[c] * g;
    }
  }
  return residual;
}

double mean_length(std::span<const Vec3> y) {
  double s = 0.0;
  for (const Vec3& p : y) s += norm(p);
  return s / static_cast<double>(std::max<std::size_t>(y.size(), 1));
}

double amplification(std::span<const Vec3> y, const std::vector<double>& w, const Vec3& target) {
  double s = 0.0;
  for (std::size_t c = 0; c < y.size(); ++c) s += w[c] * w[c] * norm2(y[c]);
  return std::sqrt(s) / norm(target);
}

}  // namespace

StencilWeights balanced_weights(std::span<const Vec3> y, const Vec3& target) {
  const double scale = mean_length(y);
  StencilWeights result;
  const Eigen::Vector4d goal(0.0, target.x / scale, target.y / scale, target.z / scale);
  const auto constraint = [scale](const Vec3& p) {
    return Eigen::Vector4d(1.0, p.x / scale, p.y / scale, p.z / scale);
  };
  const Eigen::Vector4d residual = solve<4>(y, scale, constraint, goal, result.w);
  result.residual = {residual(1) * scale, residual(2) * scale, residual(3) * scale};
  result.amplification = amplification(y, result.w, target);
  return result;
}

StencilWeights spanning_weights(std::span<const Vec3> y, const Vec3& target) {
  const double scale = mean_length(y);
  StencilWeights result;
  const Eigen::Vector3d goal(target.x / scale, target.y / scale, target.z / scale);
  const auto constraint = [scale](const Vec3& p) { return Eigen::Vector3d(p.x / scale, p.y / scale, p.z / scale); };
  const Eigen::Vector3d residual = solve<3>(y, scale, constraint, goal, result.w);
  result.residual = {residual(0) * scale, residual(1) * scale, residual(2) * scale};
  result.amplification = amplification(y, result.w, target);
  return result;
}

}  // namespace tessera
