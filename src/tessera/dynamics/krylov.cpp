#include "tessera/dynamics/krylov.hpp"

#include <array>
#include <utility>

namespace tessera {

namespace {

/// Products with several vectors at once, for parallel sums.
struct Products {
  static constexpr std::size_t at_once = 8;
  std::array<double, at_once> value{};
  Products& operator+=(const Products& o) {
    for (std::size_t i = 0; i < at_once; ++i) value[i] += o.value[i];
    return *this;
  }
};

/// w -= s q, t p, and the length of what is left.
double subtract(Vectors& w, double s, const Vectors& q, double t, const Vectors& p) {
  return std::sqrt(parallel::sum<double>(static_cast<std::int64_t>(w.size()), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    w[a] -= s * q[a];
    if (!p.empty()) w[a] -= t * p[a];
    return dot3(w[a], w[a]);
  }));
}

Eigen::MatrixXd square(const std::vector<std::vector<double>>& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i <= std::min(j + 1, n - 1); ++i)
      H(i, j) = columns[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
  return H;
}

}  // namespace

KrylovSpace::KrylovSpace(Kind kind, Vectors start) : kind_(kind), q_(std::move(start)) { keep_direction(); }

void KrylovSpace::keep_direction() {
  Field<Single> q(q_.size());
  parallel::for_each(static_cast<std::int64_t>(q_.size()), [&](std::int64_t i) {
    const Double4& v = q_[static_cast<std::size_t>(i)];
    q[static_cast<std::size_t>(i)] = {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  });
  basis_.push_back(std::move(q));
}

/// Three-term recurrence; the column above the diagonal repeats the entry below it.
std::vector<double> KrylovSpace::recur(Vectors& w) const {
  std::vector<double> column(columns_.size() + 2, 0.0);
  const std::size_t j = columns_.size();
  column[j] = inner(w, q_);
  if (j > 0) column[j - 1] = columns_[j - 1][j];
  column[j + 1] = subtract(w, column[j], q_, j > 0 ? column[j - 1] : 0.0, previous_);
  return column;
}

/// Gram-Schmidt against the whole basis, several vectors at a time.
std::vector<double> KrylovSpace::orthogonalise(Vectors& w) const {
  const auto n = static_cast<std::int64_t>(w.size());
  const auto product = [](const Single& q, const Double4& v) {
    return static_cast<double>(q.x) * v[0] + static_cast<double>(q.y) * v[1] + static_cast<double>(q.z) * v[2];
  };
  std::vector<double> column(basis_.size() + 1, 0.0);
  for (std::size_t first = 0; first < basis_.size(); first += Products::at_once) {
    const std::size_t count = std::min(Products::at_once, basis_.size() - first);
    const Products h = parallel::sum<Products>(n, [&](std::int64_t i) {
      Products p;
      for (std::size_t k = 0; k < count; ++k)
        p.value[k] = product(basis_[first + k][static_cast<std::size_t>(i)], w[static_cast<std::size_t>(i)]);
      return p;
    });
    parallel::for_each(n, [&](std::int64_t i) {
      for (std::size_t k = 0; k < count; ++k) {
        const Single& q = basis_[first + k][static_cast<std::size_t>(i)];
        w[static_cast<std::size_t>(i)] -= h.value[k] * Double4{q.x, q.y, q.z, 0.0};
      }
    });
    for (std::size_t k = 0; k < count; ++k) column[first + k] = h.value[k];
  }
  column.back() = length(w);
  return column;
}

bool KrylovSpace::extend(Vectors& w) {
  if (!columns_.empty()) keep_direction();
  columns_.push_back(kind_ == Kind::symmetric ? recur(w) : orthogonalise(w));
  const double rest = columns_.back().back();
  if (rest > 0.0) scale(w, 1.0 / rest);
  previous_.swap(q_);
  q_.swap(w);
  return rest > 0.0;
}

Ritz KrylovSpace::largest() const {
  const Eigen::MatrixXd H = square(columns_);
  const Eigen::Index n = H.cols();
  Ritz r;
  r.next = columns_.back().back();
  if (!H.allFinite() || !std::isfinite(r.next)) return {r.next * 0.0, 0.0, r.next * 0.0, Eigen::VectorXd::Zero(n)};
  if (kind_ == Kind::symmetric) {
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
    const Eigen::VectorXd diagonal = H.diagonal(), below = H.diagonal(-1);
    eigen.computeFromTridiagonal(diagonal, below);
    r.value = eigen.eigenvalues()(n - 1);
    r.coefficients = eigen.eigenvectors().col(n - 1);
    r.residual = r.next * std::abs(r.coefficients(n - 1));
    return r;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(H);
  Eigen::Index which = 0;
  r.value = eigen.eigenvalues().cwiseAbs().maxCoeff(&which);
  const Eigen::VectorXcd y = eigen.eigenvectors().col(which).normalized();
  r.coefficients = y.real();
  r.residual = r.next * std::abs(y(n - 1));
  return r;
}

Vectors KrylovSpace::vector(const Ritz& ritz) const {
  Vectors v(q_.size());
  for (std::size_t k = 0; k < static_cast<std::size_t>(ritz.coefficients.size()); ++k) {
    const double c = ritz.coefficients(static_cast<Eigen::Index>(k));
    parallel::for_each(static_cast<std::int64_t>(v.size()), [&](std::int64_t i) {
      const Single& q = basis_[k][static_cast<std::size_t>(i)];
      v[static_cast<std::size_t>(i)] += c * Double4{q.x, q.y, q.z, 0.0};
    });
  }
  if (const double l = length(v); l > 0.0) scale(v, 1.0 / l);
  return v;
}

}  // namespace tessera
