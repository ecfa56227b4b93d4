#include "tessera/discretization/stencil.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tessera {

namespace {

// Eigenvalues below this fraction of the largest belong to directions in which the points do not extend.
constexpr double rank_threshold = 1e-9;
// Pivots of a sound system do not differ by more.
constexpr double pivot_threshold = 1e-5;
// Refinement ends when this fraction of the target, or less, is left.
constexpr double round_off = 4.0 * std::numeric_limits<double>::epsilon();
constexpr int most_rounds = 3;

template <std::size_t N>
using Vector = std::array<double, N>;
template <std::size_t N>
using Matrix = std::array<Vector<N>, N>;  // symmetric, the lower triangle in use

template <std::size_t N>
double norm2(const Vector<N>& v) {
  double s = 0.0;
  for (const double x : v) s += x * x;
  return s;
}

/// M^+ b by eigenvalues, for points that lie (nearly) in a plane or line.
template <std::size_t N>
class EigenInverse {
  static constexpr int n = static_cast<int>(N);
  using Square = Eigen::Matrix<double, n, n>;

 public:
  explicit EigenInverse(const Matrix<N>& M) {
    Square A;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        A(i, j) = M[static_cast<std::size_t>(std::max(i, j))][static_cast<std::size_t>(std::min(i, j))];
    const Eigen::SelfAdjointEigenSolver<Square> eigen(A);
    const double cut = rank_threshold * eigen.eigenvalues()(n - 1);
    Eigen::Matrix<double, n, 1> values = Eigen::Matrix<double, n, 1>::Zero();
    for (int i = 0; i < n; ++i)
      if (eigen.eigenvalues()(i) > cut) values(i) = 1.0 / eigen.eigenvalues()(i);
    inverse_ = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
  }

  Vector<N> operator*(const Vector<N>& b) const {
    Vector<N> x;
    Eigen::Map<Eigen::Matrix<double, n, 1>>(x.data()) =
        inverse_ * Eigen::Map<const Eigen::Matrix<double, n, 1>>(b.data());
    return x;
  }

 private:
  Square inverse_;
};

/// M = L D L^T without pivoting, for a matrix whose pivots are of like size.
template <std::size_t N>
class Cholesky {
 public:
  explicit Cholesky(const Matrix<N>& M) : L_(M) {
    double least = std::numeric_limits<double>::infinity(), largest = 0.0;
    for (std::size_t j = 0; j < N; ++j) {
      const double pivot = L_[j][j];
      least = std::min(least, pivot), largest = std::max(largest, pivot);
      if (!(least > pivot_threshold * largest)) return;
      inverse_pivot_[j] = 1.0 / pivot;
      for (std::size_t i = j + 1; i < N; ++i) {
        const double l = L_[i][j] * inverse_pivot_[j];
        for (std::size_t k = j + 1; k <= i; ++k) L_[i][k] -= l * L_[k][j];
      }
      for (std::size_t i = j + 1; i < N; ++i) L_[i][j] *= inverse_pivot_[j];
    }
    sound_ = true;
  }

  bool is_sound() const { return sound_; }

  Vector<N> operator*(Vector<N> b) const {
    for (std::size_t i = 1; i < N; ++i)
      for (std::size_t j = 0; j < i; ++j) b[i] -= L_[i][j] * b[j];
    for (std::size_t i = 0; i < N; ++i) b[i] *= inverse_pivot_[i];
    for (std::size_t i = N - 1; i-- > 0;)
      for (std::size_t j = i + 1; j < N; ++j) b[i] -= L_[j][i] * b[j];
    return b;
  }

 private:
  Matrix<N> L_;
  Vector<N> inverse_pivot_{};
  bool sound_ = false;
};

/// The constraints that a point contributes to: (1, y/scale) for balanced weights, y/scale for spanning ones.
template <std::size_t N>
Vector<N> constraint(const Vec3& y, double inverse_scale) {
  if constexpr (N == 4)
    return {1.0, inverse_scale * y.x, inverse_scale * y.y, inverse_scale * y.z};
  else
    return {inverse_scale * y.x, inverse_scale * y.y, inverse_scale * y.z};
}

template <std::size_t N>
Vector<N> goal(const Vec3& target, double inverse_scale) {
  Vector<N> g = constraint<N>(target, inverse_scale);
  if constexpr (N == 4) g[0] = 0.0;
  return g;
}

/// w_c = scale^2 / r_c^2 g_c . multiplier.
template <std::size_t N>
StencilFunction function_of(const Vector<N>& multiplier, double scale) {
  const Vec3 gradient = scale * Vec3{multiplier[N - 3], multiplier[N - 2], multiplier[N - 1]};
  return {N == 4 ? scale * scale * multiplier[0] : 0.0, gradient};
}

/// Adds corrections until what is left of the target is round-off.
template <std::size_t N, class Inverse>
Vector<N> refine(std::span<const Vec3> y, double scale, const Inverse& inverse, const Vector<N>& target,
                 StencilFunction& function, std::span<double> w) {
  const double inverse_scale = 1.0 / scale;
  Vector<N> multiplier{}, residual = target;
  for (int round = 0; round < most_rounds; ++round) {
    const Vector<N> correction = inverse * residual;
    for (std::size_t i = 0; i < N; ++i) multiplier[i] += correction[i];
    function = function_of<N>(multiplier, scale);
    residual = target;
    for (std::size_t c = 0; c < y.size(); ++c) {
      w[c] = function(y[c]);
      const Vector<N> g = constraint<N>(y[c], inverse_scale);
      for (std::size_t i = 0; i < N; ++i) residual[i] -= w[c] * g[i];
    }
    if (norm2(residual) <= round_off * round_off * norm2(target)) break;
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

/// Minimises sum w^2 r^2 subject to sum_c w_c g_c = goal for the N-vectors g_c of the constraints:
/// w_c = g_c . M^+ goal / r_c^2 with M = sum g g^T / r^2.
template <std::size_t N>
StencilFit fit(std::span<const Vec3> y, const Vec3& target, std::span<double> w) {
  const double scale = mean_length(y), inverse_scale = 1.0 / scale;
  Matrix<N> M{};
  for (const Vec3& p : y) {
    const Vector<N> g = constraint<N>(p, inverse_scale);
    const double weight = scale * scale / norm2(p);
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j <= i; ++j) M[i][j] += weight * g[i] * g[j];
  }
  StencilFit result;
  const Vector<N> sought = goal<N>(target, inverse_scale);
  const Cholesky<N> cholesky(M);
  const Vector<N> residual = cholesky.is_sound() ? refine<N>(y, scale, cholesky, sought, result.function, w)
                                                 : refine<N>(y, scale, EigenInverse<N>(M), sought, result.function, w);
  result.residual = scale * Vec3{residual[N - 3], residual[N - 2], residual[N - 1]};
  result.amplification = amplification(y, w, target);
  return result;
}

}  // namespace

StencilFit balanced_weights(std::span<const Vec3> y, const Vec3& target, std::span<double> w) {
  return fit<4>(y, target, w);
}

StencilFit spanning_weights(std::span<const Vec3> y, const Vec3& target, std::span<double> w) {
  return fit<3>(y, target, w);
}

}  // namespace tessera
