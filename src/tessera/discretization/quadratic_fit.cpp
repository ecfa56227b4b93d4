#include "tessera/discretization/quadratic_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tessera/discretization/to_eigen.hpp"

namespace tessera {

namespace {

using Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix63 = Eigen::Matrix<double, 6, 3>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Eigenvalues below this fraction of the largest belong to directions in which the particles do not extend.
constexpr double flat_below = 1e-12;
// Ratio of pivots or eigenvalues below which positions do not determine all second derivatives.
constexpr double undetermined = 1e-10;
// So many directions are looked along, in the plane of the two axes across the fewest cells.
constexpr int directions = 6;

Vector6 products(const Vec3& X) {
  Vector6 p;
  p << X.x * X.x, X.x * X.y, X.x * X.z, X.y * X.y, X.y * X.z, X.z * X.z;
  return p;
}

/// The factors f of H.
Vector6 factors() {
  Vector6 f;
  f << 2.0, 1.0, 1.0, 2.0, 1.0, 2.0;
  return f;
}

/// Sums of products of the branches in units of their root mean square.
struct Normal {
  explicit Normal(std::span<const Vec3> branches) {
    double square = 0.0;
    for (const Vec3& X : branches) square += norm2(X);
    length = std::sqrt(square / static_cast<double>(branches.size()));
    for (const Vec3& X : branches) {
      const Vec3 c = (1.0 / length) * X;
      const Eigen::Vector3d linear = to_eigen(c);
      const Vector6 quadratic = products(c);
      sum += linear;
      first += linear * linear.transpose();
      mixed += quadratic * linear.transpose();
      second += quadratic * quadratic.transpose();
    }
  }
  double length = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Matrix3d first = Matrix3d::Zero();
  Matrix63 mixed = Matrix63::Zero();
  Matrix6 second = Matrix6::Zero();
};

/// The inverse on the space of the eigenvectors with the `rank` largest eigenvalues; false if one of those vanishes.
template <class Matrix>
bool invert(const Matrix& m, int rank, Matrix& inverse) {
  if (rank == m.rows()) {
    const Eigen::LDLT<Matrix> ldlt(m);
    const auto pivots = ldlt.vectorD();
    if (!(pivots.minCoeff() > undetermined * pivots.maxCoeff())) return false;
    inverse = ldlt.solve(Matrix::Identity());
    return true;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(m);
  const auto& values = eigen.eigenvalues();
  const auto size = static_cast<int>(values.size());
  if (!(values(size - rank) > undetermined * values(size - 1))) return false;
  const auto vectors = eigen.eigenvectors().rightCols(rank);
  inverse = vectors * values.tail(rank).cwiseInverse().asDiagonal() * vectors.transpose();
  return true;
}

/// Solves for the second derivatives in coordinates in which mixed ones count twice, as they do in norms: so those
/// that stay out of the plane vanish.
bool solve(const Normal& n, Extent extent, Matrix63& A, Matrix6& S) {
  const bool space = extent == Extent::space;
  Matrix3d first;
  if (!invert<Matrix3d>(n.first, space ? 3 : 2, first)) return false;
  A = n.mixed * first;
  Vector6 scale;  // of the products that belong to those coordinates
  scale << 0.5, std::sqrt(0.5), std::sqrt(0.5), 0.5, std::sqrt(0.5), 0.5;
  const Matrix6 rest = scale.asDiagonal() * (n.second - A * n.mixed.transpose()) * scale.asDiagonal();
  Matrix6 inverse;
  if (!invert<Matrix6>(0.5 * (rest + rest.transpose()), space ? 6 : 3, inverse)) return false;
  S = scale.asDiagonal() * (0.5 * (inverse + inverse.transpose())) * scale.asDiagonal();
  return true;
}

QuadraticFit packed(const Matrix63& A, const Matrix6& S, double length) {
  QuadraticFit fit;
  const double fourth = std::pow(length, -4);
  std::size_t at = 0;
  for (int r = 0; r < 6; ++r)
    for (int c = r; c < 6; ++c) fit.S[at++] = fourth * S(r, c);
  for (int r = 0; r < 6; ++r)
    for (int j = 0; j < 3; ++j) fit.A[static_cast<std::size_t>(3 * r + j)] = length * A(r, j);
  return fit;
}

/// Of H_a, if every position has noise of unit size, that of a too. The shares W of the others in H_a have the sum of
/// squares tr(f S f), mixed derivatives counting twice, for S is the inverse of the sum of chi' (x) chi'; that of a is
/// the negative sum of theirs.
double deviation(const Normal& n, const Matrix63& A, const Matrix6& S) {
  const Matrix3d& f = n.first;
  Vector6 all;
  all << f(0, 0), f(0, 1), f(0, 2), f(1, 1), f(1, 2), f(2, 2);
  Vector6 twice;  // how often a product stands in a symmetric tensor
  twice << 1.0, 2.0, 2.0, 1.0, 2.0, 1.0;
  const Vector6 own = factors().asDiagonal() * (S * (all - A * n.sum));
  const Vector6 squares = factors().cwiseAbs2().cwiseProduct(S.diagonal()) + own.cwiseAbs2();
  return std::sqrt(twice.dot(squares)) / (n.length * n.length);
}

/// Sum of the squares of the branches.
Matrix3d squares(std::span<const Vec3> branches) {
  Matrix3d K = Matrix3d::Zero();
  for (const Vec3& X : branches) K += to_eigen(X) * to_eigen(X).transpose();
  return K;
}

/// Across the fewest cells first, conjugate to each other, each in units of the cell's width along it; the particle
/// itself is one of those that are seen.
Matrix3d axes_in_cells(std::span<const Vec3> branches, const Symmetric3& second_moment) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Vec3& X : branches) sum += to_eigen(X);
  const Matrix3d K = squares(branches) - sum * sum.transpose() / static_cast<double>(branches.size() + 1);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3d>(K, 12.0 * to_eigen(second_moment)).eigenvectors();
}

/// The particle itself is one of those that are seen.
double depth_along(std::span<const Vec3> branches, const Eigen::Vector3d& n) {
  double s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0;
  for (const Vec3& X : branches) {
    const double s = to_eigen(X).dot(n), square = s * s;
    s1 += s, s2 += square, s3 += s * square, s4 += square * square;
  }
  const auto count = static_cast<double>(branches.size() + 1);
  s1 /= count, s2 /= count, s3 /= count, s4 /= count;
  const double variance = s2 - s1 * s1, mixed = s3 - s1 * s2;
  return variance > 0.0 ? s4 - s2 * s2 - mixed * mixed / variance : 0.0;
}

}  // namespace

Extent extent(std::span<const Vec3> branches) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(squares(branches), Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& values = eigen.eigenvalues();
  if (!(values(1) > flat_below * values(2))) return Extent::line;
  return values(0) > flat_below * values(2) ? Extent::space : Extent::plane;
}

double depth(std::span<const Vec3> branches, const Symmetric3& second_moment, Extent extent) {
  const Matrix3d axes = axes_in_cells(branches, second_moment);
  if (extent == Extent::plane) return depth_along(branches, axes.col(1));
  double least = depth_along(branches, axes.col(0));
  for (int k = 1; k < directions; ++k) {
    const double angle = k * std::numbers::pi / directions;
    least = std::min(least, depth_along(branches, std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1)));
  }
  return least;
}

FittedQuadratic fit_quadratic(std::span<const Vec3> branches, Extent extent) {
  FittedQuadratic result;
  if (extent == Extent::line || branches.empty()) return result;
  const Normal n(branches);
  Matrix63 A;
  Matrix6 S;
  if (!solve(n, extent, A, S)) return result;
  result.fit = packed(A, S, n.length);
  result.deviation = deviation(n, A, S);
  return result;
}

Symmetric3 share_of(const QuadraticFit& fit, const Vec3& branch) {
  const Vector6 p = products(branch), f = factors();
  Vector6 rest, W = Vector6::Zero();
  for (int r = 0; r < 6; ++r) {
    const double* A = fit.A.data() + static_cast<std::ptrdiff_t>(3) * r;
    rest(r) = p(r) - (A[0] * branch.x + A[1] * branch.y + A[2] * branch.z);
  }
  std::size_t at = 0;
  for (int r = 0; r < 6; ++r)
    for (int c = r; c < 6; ++c, ++at) {
      W(r) += fit.S[at] * rest(c);
      if (c != r) W(c) += fit.S[at] * rest(r);
    }
  W.array() *= f.array();
  return {W(0), W(1), W(2), W(3), W(4), W(5)};
}

ContractedFit contracted(const QuadraticFit& fit, const Symmetric3& M) {
  const std::array<double, 6> m{M.xx, M.xy, M.xz, M.yy, M.yz, M.zz};
  ContractedFit result;
  std::size_t at = 0;
  for (std::size_t r = 0; r < 6; ++r)
    for (std::size_t c = r; c < 6; ++c, ++at) {
      result.of_products[r] += 2.0 * fit.S[at] * m[c];
      if (c != r) result.of_products[c] += 2.0 * fit.S[at] * m[r];
    }
  for (std::size_t r = 0; r < 6; ++r)
    for (int j = 0; j < 3; ++j)
      result.of_branch[j] += result.of_products[r] * fit.A[3 * r + static_cast<std::size_t>(j)];
  return result;
}

}  // namespace tessera
