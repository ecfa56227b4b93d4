#include "tessera/discretization/stencil.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

// Eigenvalues below this fraction of the largest belong to directions in which the points do not extend.
constexpr double rank_threshold = 1e-9;
// Pivots of a sound system do not differ by more.
constexpr double pivot_threshold = 1e-5;

template <int N>
using Vector = Eigen::Matrix<double, N, 1>;
template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

/// M^+ b: by Cholesky where the matrix is sound, by eigenvalues where the points lie (nearly) in a plane or line.
template <int N>
class PseudoInverse {
 public:
  explicit PseudoInverse(const Matrix<N>& M) : factors_(M) {
    const Vector<N> pivots = factors_.vectorD();
    sound_ = pivots.minCoeff() > pivot_threshold * pivots.maxCoeff();
    if (sound_) return;
    eigen_.compute(M);
    const double cut = rank_threshold * eigen_.eigenvalues()(N - 1);
    for (int i = 0; i < N; ++i)
      inverse_values_(i) = eigen_.eigenvalues()(i) > cut ? 1.0 / eigen_.eigenvalues()(i) : 0.0;
  }

  Vector<N> operator*(const Vector<N>& b) const {
    if (sound_) return factors_.solve(b);
    return eigen_.eigenvectors() * inverse_values_.cwiseProduct(eigen_.eigenvectors().transpose() * b);
  }

 private:
  Eigen::LDLT<Matrix<N>> factors_;
  Eigen::SelfAdjointEigenSolver<Matrix<N>> eigen_;
  Vector<N> inverse_values_ = Vector<N>::Zero();
  bool sound_ = false;
};

/// Minimises sum w^2 r^2 subject to sum_c w_c g_c = target for the N-vectors g_c of the constraints:
/// w_c = g_c . M^+ target / r_c^2 with M = sum g g^T / r^2. Two rounds of refinement bring the residual to round-off.
template <int N, class Constraint>
Vector<N> solve(std::span<const Vec3> y, double scale, const Constraint& constraint, const Vector<N>& target,
                std::span<double> w) {
  Matrix<N> M = Matrix<N>::Zero();
  for (const Vec3& p : y) {
    const Vector<N> g = constraint(p);
    M.noalias() += g * g.transpose() * (scale * scale / norm2(p));
  }
  const PseudoInverse<N> inverse(M);
  std::fill(w.begin(), w.end(), 0.0);
  Vector<N> residual = target;
  for (int round = 0; round < 3; ++round) {
    const Vector<N> multiplier = inverse * residual;
    residual = target;
    for (std::size_t c = 0; c < y.size(); ++c) {
      const Vector<N> g = constraint(y[c]);
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

double amplification(std::span<const Vec3> y, std::span<const double> w, const Vec3& target) {
  double s = 0.0;
  for (std::size_t c = 0; c < y.size(); ++c) s += w[c] * w[c] * norm2(y[c]);
  return std::sqrt(s) / norm(target);
}

}  // namespace

StencilFit balanced_weights(std::span<const Vec3> y, const Vec3& target, std::span<double> w) {
  const double scale = mean_length(y);
  const Eigen::Vector4d goal(0.0, target.x / scale, target.y / scale, target.z / scale);
  const auto constraint = [scale](const Vec3& p) {
    return Eigen::Vector4d(1.0, p.x / scale, p.y / scale, p.z / scale);
  };
  const Eigen::Vector4d residual = solve<4>(y, scale, constraint, goal, w);
  return {scale * Vec3{residual(1), residual(2), residual(3)}, amplification(y, w, target)};
}

StencilFit spanning_weights(std::span<const Vec3> y, const Vec3& target, std::span<double> w) {
  const double scale = mean_length(y);
  const Eigen::Vector3d goal(target.x / scale, target.y / scale, target.z / scale);
  const auto constraint = [scale](const Vec3& p) { return Eigen::Vector3d(p.x / scale, p.y / scale, p.z / scale); };
  const Eigen::Vector3d residual = solve<3>(y, scale, constraint, goal, w);
  return {scale * Vec3{residual(0), residual(1), residual(2)}, amplification(y, w, target)};
}

}  // namespace tessera
