#include "tessera/dynamics/spectral.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

using Vectors = Field<Double4>;

double inner(const Vectors& a, const Vectors& b) {
  return parallel::sum<double>(static_cast<std::int64_t>(a.size()), [&](std::int64_t i) {
    return dot3(a[static_cast<std::size_t>(i)], b[static_cast<std::size_t>(i)]);
  });
}

void scale(Vectors& a, double s) {
  parallel::for_each(static_cast<std::int64_t>(a.size()), [&](std::int64_t i) { a[static_cast<std::size_t>(i)] *= s; });
}

/// a -= s b
void subtract(Vectors& a, double s, const Vectors& b) {
  parallel::for_each(static_cast<std::int64_t>(a.size()),
                     [&](std::int64_t i) { a[static_cast<std::size_t>(i)] -= s * b[static_cast<std::size_t>(i)]; });
}

/// A reproducible vector without structure: every mode takes part.
Vectors rough_vector(std::size_t n) {
  Vectors v(n);
  std::uint64_t state = 0x9E3779B97F4A7C15ULL;
  const auto next = [&state] {
    state ^= state << 13U;
    state ^= state >> 7U;
    state ^= state << 17U;
    return static_cast<double>(state >> 11U) * 0x1p-53 - 0.5;
  };
  for (Double4& d : v) {
    const double x = next(), y = next(), z = next();
    d = Double4{x, y, z, 0.0};
  }
  return v;
}

}  // namespace

/// M^-1/2 K M^-1/2 w by differences of the elastic forces; prescribed components do not move.
class LinearisedForces {
 public:
  LinearisedForces(const System& s, const State& state, std::span<const Vec3> walls, double L)
      : s_(s), forces_(s), moved_(state), x_(state.x), action_{walls, {}, {}}, amplitude_(1e-5 * L) {
    forces_.evaluate(moved_, action_, 0.0);
    f_ = forces_.total();
  }

  std::size_t size() const { return s_.d.X.size(); }

  void hold(Vectors& w) const {
    for (const ParticleConstraint& c : s_.d.constraints) {
      Double4& v = w[static_cast<std::size_t>(c.particle)];
      v = to_kernel(to_vec3(v) - c.D * to_vec3(v));
    }
  }

  Vectors operator()(const Vectors& w) {
    Vectors u(w.size());
    double largest = 0.0;
    for (std::size_t a = 0; a < w.size(); ++a) {
      u[a] = (1.0 / std::sqrt(s_.mass[a])) * w[a];
      largest = std::max(largest, dot3(u[a], u[a]));
    }
    const double epsilon = amplitude_ / std::sqrt(largest);
    for (std::size_t a = 0; a < w.size(); ++a) moved_.x[a] = x_[a] + epsilon * u[a];
    forces_.evaluate(moved_, action_, 0.0);
    for (std::size_t a = 0; a < w.size(); ++a)
      u[a] = (1.0 / (epsilon * std::sqrt(s_.mass[a]))) * (f_[a] - forces_.total()[a]);
    hold(u);
    return u;
  }

 private:
  const System& s_;
  Forces forces_;
  State moved_;
  const Vectors x_;
  ExternalAction action_;
  double amplitude_;
  Vectors f_;
};

namespace {

/// Largest eigenvalue of the tridiagonal matrix and the size of the last component of its vector.
std::pair<double, double> largest_ritz(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const auto n = static_cast<Eigen::Index>(alpha.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  const Eigen::VectorXd diagonal = Eigen::Map<const Eigen::VectorXd>(alpha.data(), n);
  const Eigen::VectorXd off = Eigen::Map<const Eigen::VectorXd>(beta.data(), n - 1);
  eigen.computeFromTridiagonal(diagonal, off);
  return {eigen.eigenvalues()(n - 1), std::abs(eigen.eigenvectors()(n - 1, n - 1))};
}

constexpr int most_iterations = 80, power_iterations = 120;
constexpr double tolerance = 0.002;
// A small residual alone may belong to a lower neighbour of the largest value, so the value must also have settled.
constexpr std::size_t settling_iterations = 6;
constexpr double settled = 2e-4;

}  // namespace

/// Three-term Lanczos; the bound is the Ritz value plus its residual.
double SpectralEstimator::lanczos(LinearisedForces& K) {
  Vectors q = vector_, previous(q.size(), Double4{});
  Vectors best = q;  // a sum of the basis, rich in the highest modes, for the next start
  std::vector<double> alpha, beta;
  double bound = 0.0;
  std::vector<double> values;
  for (int i = 0; i < most_iterations; ++i) {
    Vectors w = K(q);
    alpha.push_back(inner(w, q));
    subtract(w, alpha.back(), q);
    if (i > 0) subtract(w, beta.back(), previous);
    const double b = std::sqrt(inner(w, w));
    const auto [value, last] = largest_ritz(alpha, beta);
    bound = value + b * last;
    values.push_back(value);
    const bool steady = values.size() > settling_iterations &&
                        value - values[values.size() - 1 - settling_iterations] <= settled * value;
    if ((steady && b * last <= tolerance * value) || b <= 1e-12 * std::abs(value)) break;
    beta.push_back(b);
    scale(w, 1.0 / b);
    subtract(best, (i % 2 == 0) ? 1.0 : -1.0, w);
    previous = std::exchange(q, std::move(w));
  }
  vector_ = std::move(best);
  return bound;
}

/// For forces without a potential, whose linearisation is not symmetric: the growth of repeated application.
double SpectralEstimator::power_iteration(LinearisedForces& K) {
  double growth = 0.0;
  for (int i = 0; i < power_iterations; ++i) {
    Vectors w = K(vector_);
    growth = std::sqrt(inner(w, w));
    scale(w, 1.0 / growth);
    vector_ = std::move(w);
  }
  return 1.1 * growth;  // the iteration comes from below; a tenth covers what it has left
}

double SpectralEstimator::largest_frequency(const State& state, std::span<const Vec3> walls, double L) {
  LinearisedForces K(system_, state, walls, L);
  if (vector_.empty()) vector_ = rough_vector(K.size());
  K.hold(vector_);
  const double length = std::sqrt(inner(vector_, vector_));
  if (length == 0.0) return 0.0;  // every particle is held
  scale(vector_, 1.0 / length);
  const double eigenvalue = has_potential(system_.d) ? lanczos(K) : power_iteration(K);
  return std::sqrt(std::max(eigenvalue, 0.0));
}

}  // namespace tessera
