#include "tessera/discretization/quadratic_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>

#include "tessera/discretization/nearby.hpp"
#include "tessera/parallel/collect.hpp"
#include "tessera/parallel/workspaces.hpp"

namespace tessera {

namespace {

// Numbers of particles that are tried one after the other: from a block of 3 x 3 x 3 around an inner particle to more
// where they lie to one side.
constexpr std::array<std::size_t, 7> sizes{26, 32, 38, 44, 56, 70, 90};
// A stencil is wide enough when it amplifies no more than this: wide stencils keep the step long...
constexpr double sound = 0.95;
// ... and the widest one must not amplify more than this. Two layers of particles amplify by 1.8 to 4.
constexpr double largest_amplification = 1.75;
// Eigenvalues below this fraction of the largest belong to directions in which the particles do not extend.
constexpr double rank_threshold = 1e-12;

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

Vector9 polynomial(const Vec3& y) {
  Vector9 v;
  v << y.x, y.y, y.z, y.x * y.x, y.x * y.y, y.x * y.z, y.y * y.y, y.y * y.z, y.z * y.z;
  return v;
}

/// Factors that turn products of components into the terms of Taylor's series.
Vector9 taylor() {
  Vector9 v;
  v << 1, 1, 1, 0.5, 1, 1, 0.5, 1, 0.5;
  return v;
}

/// The fit to particles at y, lengths in units of `scale`.
class Fitter {
 public:
  Fitter(std::span<const Vec3> y, double scale) : y_(y), scale_(scale) {
    M_.setZero();
    for (const Vec3& p : y_) {
      const Vector9 t = terms(p);
      M_.noalias() += (1.0 / norm2(p / scale_)) * t * t.transpose();
    }
  }

  /// False where the particles do not determine all second derivatives.
  bool solve() {
    const Eigen::LLT<Matrix9> cholesky(M_);
    const auto pivots = cholesky.matrixLLT().diagonal();  // roots of them
    const double ratio = pivots.minCoeff() / pivots.maxCoeff();
    if (cholesky.info() != Eigen::Success || !(ratio * ratio > rank_threshold)) return false;
    inverse_ = cholesky.solve(Matrix9::Identity());
    return true;
  }

  /// For particles in one plane, whose position out of the plane has no part in the motion. False if they determine
  /// less than the five terms in the plane.
  bool solve_in_plane() {
    const Eigen::SelfAdjointEigenSolver<Matrix9> eigen(M_);
    const double cut = rank_threshold * eigen.eigenvalues()(8);
    Vector9 values = Vector9::Zero();
    int rank = 0;
    for (int i = 0; i < 9; ++i)
      if (eigen.eigenvalues()(i) > cut) values(i) = 1.0 / eigen.eigenvalues()(i), ++rank;
    inverse_ = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
    return rank == 5;
  }

  QuadraticFit fit() const {
    QuadraticFit f;
    const Vector9 factor = taylor();
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 9; ++c)
        f.S[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
            inverse_(3 + r, c) * factor(c) * (c < 3 ? 1.0 / scale_ : 1.0 / (scale_ * scale_));
    return f;
  }

  /// scale^2 sqrt(sum W^2), mixed derivatives counted twice.
  double amplification() const {
    Eigen::Matrix<double, 6, 1> square = Eigen::Matrix<double, 6, 1>::Zero();
    for (const Vec3& p : y_) square += ((1.0 / norm2(p / scale_)) * (inverse_.bottomRows<6>() * terms(p))).cwiseAbs2();
    return std::sqrt(square(0) + square(3) + square(5) + 2.0 * (square(1) + square(2) + square(4)));
  }

 private:
  Vector9 terms(const Vec3& p) const { return polynomial(p / scale_).cwiseProduct(taylor()); }

  std::span<const Vec3> y_;
  double scale_;
  Matrix9 M_, inverse_;
};

/// Do the particle and those around it lie in one plane?
bool is_flat(std::span<const Vec3> y, double size) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : y) {
    const Eigen::Vector3d v(p.x, p.y, p.z);
    spread += v * v.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()(0) < 1e-14 * size * size;
}

struct Choice {
  std::span<const Index> stencil;
  QuadraticFit fit;
  double amplification = std::numeric_limits<double>::infinity();
  bool resolved = false;
};

/// Widens the stencil until it is sound.
class FitChooser {
 public:
  FitChooser(std::span<const Vec3> X, const Csr<FaceOfCell>& faces) : X_(X), nearby_(X, faces) {}

  Choice choose(Index a, double volume) {
    const double size = std::cbrt(volume);
    nearby_.start(a, size);
    Choice choice;
    std::size_t before = 0;
    for (const std::size_t wanted : sizes) {
      choice.stencil = nearby_.nearest(wanted);
      if (choice.stencil.size() == before) break;  // the body has no more particles
      before = choice.stencil.size();
      if (fit(a, size, choice) && choice.amplification <= sound) break;
    }
    choice.resolved = choice.amplification <= largest_amplification;
    if (!choice.resolved) choice.fit = {}, choice.stencil = {};
    return choice;
  }

 private:
  bool fit(Index a, double size, Choice& choice) {
    y_.clear();
    for (const Index b : choice.stencil)
      y_.push_back(X_[static_cast<std::size_t>(b)] - X_[static_cast<std::size_t>(a)]);
    Fitter fitter(y_, size);
    choice.amplification = std::numeric_limits<double>::infinity();
    if (!fitter.solve() && !(is_flat(y_, size) && fitter.solve_in_plane())) return false;
    choice.fit = fitter.fit();
    choice.amplification = fitter.amplification();
    return true;
  }

  std::span<const Vec3> X_;
  NearbyParticles nearby_;
  std::vector<Vec3> y_;
};

}  // namespace

Symmetric3 QuadraticFit::weights(const Vec3& y) const {
  const Symmetric3 p = square(y);
  const auto row = [&](std::size_t r) {
    const std::array<double, 9>& s = S[r];
    return s[0] * y.x + s[1] * y.y + s[2] * y.z + s[3] * p.xx + s[4] * p.xy + s[5] * p.xz + s[6] * p.yy + s[7] * p.yz +
           s[8] * p.zz;
  };
  return (1.0 / norm2(y)) * Symmetric3{row(0), row(1), row(2), row(3), row(4), row(5)};
}

QuadraticFits quadratic_fits(std::span<const Vec3> X, std::span<const double> volume, const Csr<FaceOfCell>& faces) {
  QuadraticFits fits;
  fits.fit.resize(X.size());
  fits.resolved.resize(X.size());
  fits.amplification.resize(X.size());
  parallel::Workspaces<FitChooser> choosers([&] { return std::make_unique<FitChooser>(X, faces); });
  using Chooser = parallel::Workspaces<FitChooser>::Lease;
  std::vector<Index> row;
  fits.stencil =
      parallel::collect_rows<Index>(static_cast<Index>(X.size()), [&](Index a, parallel::RowCollector<Index>& out) {
        const auto k = static_cast<std::size_t>(a);
        const Chooser chooser(choosers);
        const Choice choice = chooser->choose(a, volume[k]);
        fits.fit[k] = choice.fit;
        fits.resolved[k] = choice.resolved;
        fits.amplification[k] = choice.amplification;
        std::vector<Index> sorted(choice.stencil.begin(), choice.stencil.end());
        std::sort(sorted.begin(), sorted.end());
        for (const Index b : sorted) out.add(b);
      });
  return fits;
}

}  // namespace tessera
