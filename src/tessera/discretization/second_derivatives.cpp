#include "tessera/discretization/second_derivatives.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>

#include "tessera/discretization/first_derivatives.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

// Second derivatives that amplify noise more than this are not resolved. Two layers of particles amplify without end.
constexpr double largest_amplification = 12.0;
// The weight of a cell in means falls with this power of its deviation: those at sides count for little.
constexpr int falls_with = 8;
// How much of the mean variance the fit adds to each component of G's, so that it stays regular.
constexpr double regular = 1e-3;
// Eigenvalues below this fraction of the largest belong to directions in which the particles do not extend.
constexpr double flat_below = 1e-12;
// Ratio of pivots below which first derivatives do not determine all second ones.
constexpr double undetermined = 1e-10;

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix96 = Eigen::Matrix<double, 9, 6>;
using Matrix69 = Eigen::Matrix<double, 6, 9>;

constexpr std::array<std::array<int, 3>, 3> place{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};

Vector3d to_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Components as factors of xx, xy, xz, yy, yz, zz.
std::array<double, 6> factors(const Symmetric3& m) { return {m.xx, 2.0 * m.xy, 2.0 * m.xz, m.yy, 2.0 * m.yz, m.zz}; }

/// What F'_a makes of noise of unit size in every particle's position.
Matrix3d variance(const FirstDerivatives& F, Index a, double volume) {
  Matrix3d S = Matrix3d::Zero();
  Vector3d sum = Vector3d::Zero();
  F.for_each_term(a, [&](Index, const Vec3& B) {
    const Vector3d v = to_eigen(B);
    S += v * v.transpose();
    sum += v;
  });
  return (S + sum * sum.transpose()) / (volume * volume);
}

/// One particle's fit while it is put together.
struct Fit {
  Matrix3d inverse;               // K^-1
  Matrix96 L = Matrix96::Zero();  // differences of F' for each second derivative
  Matrix9 noise = Matrix9::Zero();
  double square = 0.0;  // mean square of the distances to the neighbours
  bool flat = false;
  Vector3d normal = Vector3d::Zero();  // of the plane, if it is
};

/// Of second derivatives where positions have noise of unit size.
struct Noise {
  double deviation = std::numeric_limits<double>::infinity();  // [1/m2]
  double amplification = std::numeric_limits<double>::infinity();
};

class Fitter {
 public:
  Fitter(const Discretization& d, const SecondOrder& s, std::span<const Vec3> C, std::span<const MeanError> errors)
      : d_(d), F_(d, s), C_(C), errors_(errors), variance_(d.X.size()) {
    parallel::for_each(d.particles(), [&](std::int64_t a) {
      variance_[static_cast<std::size_t>(a)] =
          variance(F_, static_cast<Index>(a), d_.volume[static_cast<std::size_t>(a)]);
    });
  }

  /// Sets the map and returns what it makes of noise, infinitely much where there is no fit.
  Noise fit(Index a, SecondDerivatives::Map& map) const {
    Fit f;
    if (!spread(a, f)) return {};
    collect(a, f);
    Matrix69 S;
    if (!solve(f, S)) return {};
    for (int r = 0; r < 6; ++r)
      for (int j = 0; j < 3; ++j) {
        const Eigen::RowVector3d row = S.block<1, 3>(r, 3 * j) * f.inverse;
        for (int k = 0; k < 3; ++k) map[static_cast<std::size_t>(9 * r + 3 * j + k)] = row(k);
      }
    const Matrix6 v = S * f.noise * S.transpose();
    const double deviation = std::sqrt(v(0, 0) + v(3, 3) + v(5, 5) + 2.0 * (v(1, 1) + v(2, 2) + v(4, 4)));
    return {deviation, f.square * deviation};
  }

 private:
  Vec3 offset(Index a, Index b) const { return C_[static_cast<std::size_t>(b)] - C_[static_cast<std::size_t>(a)]; }

  bool spread(Index a, Fit& f) const {
    Matrix3d K = Matrix3d::Zero();
    int n = 0;
    F_.for_each_neighbour(a, [&](Index b) {
      const Vector3d c = to_eigen(offset(a, b));
      K += c * c.transpose();
      ++n;
    });
    if (n < 2) return false;
    f.square = K.trace() / n;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(K);
    const Vector3d values = eigen.eigenvalues();
    if (!(values(1) > flat_below * values(2))) return false;
    f.flat = !(values(0) > flat_below * values(2));
    if (f.flat) f.normal = eigen.eigenvectors().col(0);
    f.inverse.setZero();
    for (int i = f.flat ? 1 : 0; i < 3; ++i)
      f.inverse += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() / values(i);
    return true;
  }

  void collect(Index a, Fit& f) const {
    Vector3d own = Vector3d::Zero();
    F_.for_each_neighbour(a, [&](Index b) {
      const Vec3 c = offset(a, b);
      const Vector3d w = f.inverse * to_eigen(c);
      for (int j = 0; j < 3; ++j) {
        const auto k_j = static_cast<std::size_t>(j);
        const std::array<double, 6> error =
            factors(errors_[static_cast<std::size_t>(b)][k_j] - errors_[static_cast<std::size_t>(a)][k_j]);
        for (int k = 0; k < 3; ++k) {
          for (int i = 0; i < 3; ++i) f.L(3 * j + k, place[k_j][static_cast<std::size_t>(i)]) += w(k) * c[i];
          for (int r = 0; r < 6; ++r) f.L(3 * j + k, r) += w(k) * error[static_cast<std::size_t>(r)];
        }
      }
      add_noise(variance_[static_cast<std::size_t>(b)], w, f.noise);
      own += w;
    });
    add_noise(variance_[static_cast<std::size_t>(a)], own, f.noise);
  }

  static void add_noise(const Matrix3d& S, const Vector3d& w, Matrix9& noise) {
    const Matrix3d ww = w * w.transpose();
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) noise.block<3, 3>(3 * j, 3 * i) += S(j, i) * ww;
  }

  /// The inverse of L that amplifies least.
  static bool solve(const Fit& f, Matrix69& S) {
    const Matrix9 weight = f.noise + (regular / 9.0 * f.noise.trace()) * Matrix9::Identity();
    const Eigen::LLT<Matrix9> cholesky(weight);
    if (cholesky.info() != Eigen::Success) return false;
    if (f.flat) return solve_in_plane(f, cholesky, S);
    const Matrix96 right = cholesky.solve(f.L);
    const Eigen::LDLT<Matrix6> ldlt(f.L.transpose() * right);
    const auto pivots = ldlt.vectorD();
    if (!(pivots.minCoeff() > undetermined * pivots.maxCoeff())) return false;
    S = ldlt.solve(right.transpose());
    return true;
  }

  /// The same of the first and second derivatives in the plane.
  static bool solve_in_plane(const Fit& f, const Eigen::LLT<Matrix9>& weight, Matrix69& S) {
    const Matrix3d P = Matrix3d::Identity() - f.normal * f.normal.transpose();
    Matrix9 first;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) first.block<3, 3>(3 * j, 3 * i) = P(j, i) * P;
    const Matrix96 L = first * f.L * in_plane(P);
    const Matrix96 right = weight.solve(L);
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(L.transpose() * right);
    const double cut = undetermined * eigen.eigenvalues()(5);
    if (!(eigen.eigenvalues()(3) > cut)) return false;
    const auto vectors = eigen.eigenvectors().rightCols<3>();
    S = vectors * eigen.eigenvalues().tail<3>().cwiseInverse().asDiagonal() * vectors.transpose() * right.transpose() *
        first;
    return true;
  }

  /// H -> P H P by components.
  static Matrix6 in_plane(const Matrix3d& P) {
    Matrix6 Q;
    for (int c = 0; c < 6; ++c) {
      Matrix3d unit = Matrix3d::Zero();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (place[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] == c) unit(i, j) = 1.0;
      const Matrix3d image = P * unit * P;
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) Q(place[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], c) = image(i, j);
    }
    return Q;
  }

  const Discretization& d_;
  FirstDerivatives F_;
  std::span<const Vec3> C_;
  std::span<const MeanError> errors_;
  std::vector<Matrix3d> variance_;
};

/// Adds up entries of equal particles, which become ascending.
template <class Entry, class Add>
void join(std::vector<Entry>& entries, Add&& add) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& l, const Entry& r) { return l.particle < r.particle; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < entries.size(); ++i)
    if (entries[i].particle == entries[last].particle)
      add(entries[last], entries[i]);
    else
      entries[++last] = entries[i];
  entries.resize(std::min(entries.size(), last + 1));
}

/// How much of F'_b the mean H_a has: one vector for each second derivative.
struct GradientShare {
  Index particle = 0;
  std::array<Vec3, 6> m;
};

std::vector<GradientShare> gradient_shares(const FirstDerivatives& F, const SecondDerivatives& s,
                                           std::span<const Vec3> C, Index a) {
  double sum = 0.0;
  std::vector<Index> cells{a};
  F.for_each_neighbour(a, [&](Index b) { cells.push_back(b); });
  for (const Index b : cells) sum += s.weight[static_cast<std::size_t>(b)];
  std::vector<GradientShare> shares;
  for (const Index b : cells) {
    const auto k = static_cast<std::size_t>(b);
    if (s.weight[k] == 0.0) continue;
    GradientShare own{b, {}};
    F.for_each_neighbour(b, [&](Index c) {
      const Vec3 way = (s.weight[k] / sum) * (C[static_cast<std::size_t>(c)] - C[k]);
      GradientShare share{c, {}};
      for (std::size_t r = 0; r < 6; ++r) {
        const double* row = s.map[k].data() + 9 * r;
        share.m[r] = {row[0] * way.x + row[1] * way.y + row[2] * way.z,
                      row[3] * way.x + row[4] * way.y + row[5] * way.z,
                      row[6] * way.x + row[7] * way.y + row[8] * way.z};
        own.m[r] -= share.m[r];
      }
      shares.push_back(share);
    });
    shares.push_back(own);
  }
  join(shares, [](GradientShare& to, const GradientShare& more) {
    for (std::size_t r = 0; r < 6; ++r) to.m[r] += more.m[r];
  });
  return shares;
}

}  // namespace

SecondDerivatives second_derivatives(const Discretization& d, const SecondOrder& s, std::span<const Vec3> C,
                                     std::span<const MeanError> errors, std::span<const char> refused) {
  const Fitter fitter(d, s, C, errors);
  const double size = std::cbrt(std::accumulate(d.volume.begin(), d.volume.end(), 0.0) / d.particles());
  SecondDerivatives result;
  result.map.resize(d.X.size());
  result.resolved.resize(d.X.size());
  result.weight.resize(d.X.size());
  result.amplification.resize(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    SecondDerivatives::Map& map = result.map[a];
    map.fill(0.0);
    const Noise noise = refused[a] ? Noise{} : fitter.fit(static_cast<Index>(i), map);
    result.amplification[a] = noise.amplification;
    result.resolved[a] = noise.amplification <= largest_amplification;
    if (result.resolved[a])
      result.weight[a] = std::pow(size * size * noise.deviation, -falls_with);
    else
      map.fill(0.0);
  });
  return result;
}

std::vector<CurvatureTerm> mean_curvature(const Discretization& d, const SecondOrder& s, std::span<const Vec3> C,
                                          Index a) {
  if (!s.derivatives.resolved[static_cast<std::size_t>(a)]) return {};
  const FirstDerivatives F(d, s);
  std::vector<CurvatureTerm> terms;
  for (const GradientShare& share : gradient_shares(F, s.derivatives, C, a)) {
    const double inverse_volume = 1.0 / d.volume[static_cast<std::size_t>(share.particle)];
    Symmetric3 own;
    F.for_each_term(share.particle, [&](Index b, const Vec3& B) {
      const std::array<Vec3, 6>& m = share.m;
      const Symmetric3 W = inverse_volume * Symmetric3{dot(m[0], B), dot(m[1], B), dot(m[2], B),
                                                       dot(m[3], B), dot(m[4], B), dot(m[5], B)};
      terms.push_back({b, W});
      own -= W;
    });
    terms.push_back({share.particle, own});
  }
  join(terms, [](CurvatureTerm& to, const CurvatureTerm& more) { to.W += more.W; });
  std::erase_if(terms, [a](const CurvatureTerm& t) { return t.particle == a; });
  return terms;
}

}  // namespace tessera
