#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "support/consistent_reference.hpp"
#include "tessera/discretization/second_derivatives.hpp"

namespace tessera::test {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Matrix96 = Eigen::Matrix<double, 9, 6>;
using Matrix69 = Eigen::Matrix<double, 6, 9>;

Eigen::Vector3d to_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

using Terms = std::map<std::size_t, Vec3>;

/// F' of all cells as sums over particles, from faces whose positions follow particles alone. A cell has one sum for
/// the faces without prescribed motion and one for each other face.
std::vector<std::vector<Terms>> gradients(const VoronoiBody& body) {
  VoronoiBody untied = body;
  untied.D.assign(body.D.size(), {});
  const ConsistentReference faces(untied);
  const std::size_t interior = body.cells.interior.size();
  std::vector<std::vector<Terms>> B(body.X.size(), std::vector<Terms>(1));
  for (std::size_t a = 0; a < body.X.size(); ++a)
    for (const auto& [f, area] : faces.faces_of[a]) {
      const bool is_held = f >= interior && !is_zero(body.D[f - interior]);
      if (is_held) B[a].emplace_back();
      Terms& to = is_held ? B[a].back() : B[a].front();
      for (const auto& [b, W] : faces.faces[f].W) to[b] += (W(0, 0) / body.cells.volume[a]) * area;
    }
  return B;
}

/// The second derivatives of (24) and their noise by the words of the theory: what quadratic motions give is found by
/// moving the particles so, and of all maps that are exact for these the least noisy one is a stationary point of a
/// Lagrangian.
struct Fit {
  Matrix69 map;                                 // of G [1/m2]
  double deviation = 0.0, amplification = 0.0;  // [1/m2], of unit noise; and in units of the neighbours' distances
};

class Fits {
 public:
  explicit Fits(const VoronoiBody& body) : body_(body), near_(ConsistentReference(body).near), B_(gradients(body)) {}

  Fit at(std::size_t a) const {
    Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
    for (const std::size_t b : near_[a]) K += way(a, b) * way(a, b).transpose();
    const Eigen::Matrix3d inverse = K.inverse();
    Matrix96 L = Matrix96::Zero();
    Matrix9 noise = noise_of(a, a, inverse);
    for (const std::size_t b : near_[a]) {
      noise += noise_of(a, b, inverse);
      for (int r = 0; r < 6; ++r) L.col(r) += differences(gradient(b, a, r) - gradient(a, a, r), inverse * way(a, b));
    }
    Eigen::Matrix<double, 15, 15> system = Eigen::Matrix<double, 15, 15>::Zero();
    system.topLeftCorner<9, 9>() = noise + 1e-3 * noise.trace() / 9.0 * Matrix9::Identity();
    system.topRightCorner<9, 6>() = L;
    system.bottomLeftCorner<6, 9>() = L.transpose();
    Eigen::Matrix<double, 15, 6> right = Eigen::Matrix<double, 15, 6>::Zero();
    right.bottomRows<6>().setIdentity();
    // Rows and columns of very different size: the noise is scaled to one.
    const double scale = system.topLeftCorner<9, 9>().trace() / 9.0;
    system.topLeftCorner<9, 9>() /= scale;
    const Matrix69 S = system.fullPivLu().solve(right).topRows<9>().transpose();
    Fit fit;
    constexpr double times[] = {1, 2, 2, 1, 2, 1};
    double square = 0.0;
    for (int r = 0; r < 6; ++r) square += times[r] * (S.row(r) * noise * S.row(r).transpose())(0);
    fit.deviation = std::sqrt(square);
    fit.amplification = K.trace() / static_cast<double>(near_[a].size()) * fit.deviation;
    for (int j = 0; j < 3; ++j) fit.map.middleCols<3>(3 * j) = S.middleCols<3>(3 * j) * inverse;
    return fit;
  }

 private:
  Eigen::Vector3d way(std::size_t a, std::size_t b) const {
    return to_eigen(body_.cells.centroid[b] - body_.cells.centroid[a]);
  }

  static Eigen::Matrix<double, 9, 1> differences(const Eigen::Vector3d& dF, const Eigen::Vector3d& w) {
    Eigen::Matrix<double, 9, 1> g;
    for (int j = 0; j < 3; ++j) g.segment<3>(3 * j) = dF(j) * w;
    return g;
  }

  /// F'_b of the motion whose second derivative number r is one, about particle `origin`.
  Eigen::Vector3d gradient(std::size_t b, std::size_t origin, int r) const {
    Eigen::Vector3d F = Eigen::Vector3d::Zero();
    for (const Terms& terms : B_[b])
      for (const auto& [c, weight] : terms) {
        const Vec3 Y = body_.X[c] - body_.X[origin];
        const double motion[] = {0.5 * Y.x * Y.x, Y.x * Y.y, Y.x * Y.z, 0.5 * Y.y * Y.y, Y.y * Y.z, 0.5 * Y.z * Y.z};
        F += motion[r] * to_eigen(weight);
      }
    return F;
  }

  /// What an error of F'_b adds to the covariance of a's differences.
  Matrix9 noise_of(std::size_t a, std::size_t b, const Eigen::Matrix3d& inverse) const {
    Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
    Eigen::Vector3d of_itself = Eigen::Vector3d::Zero();
    for (const Terms& terms : B_[b])
      for (const auto& [c, weight] : terms)
        if (c == b)
          of_itself += to_eigen(weight);
        else
          own += to_eigen(weight) * to_eigen(weight).transpose();
    own += of_itself * of_itself.transpose();
    Eigen::Vector3d w = Eigen::Vector3d::Zero();
    if (a == b)
      for (const std::size_t c : near_[a]) w -= inverse * way(a, c);
    else
      w = inverse * way(a, b);
    Matrix9 noise;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) noise.block<3, 3>(3 * j, 3 * i) = own(j, i) * w * w.transpose();
    return noise;
  }

  const VoronoiBody& body_;
  std::vector<std::set<std::size_t>> near_;
  std::vector<std::vector<Terms>> B_;
};

Discretization curved(const VoronoiBody& body) {
  return discretize(Method::consistent, body, Integration::second_order);
}

/// Three layers of which two come together along x: what they tell of the second derivatives across becomes less.
VoronoiBody wedge() {
  const Solid solid = box({9, 4, 3});
  VoronoiBody body = voronoi_body(solid, {9, 4, 3}, 0.1, 5, nothing);
  for (Vec3& X : body.X)
    if (X.z > 1.0 && X.z < 2.0) X.z = 2.5 + (X.z - 2.5) * (1.0 - 0.098 * X.x);
  body.cells = voronoi_cells(body.X, solid, Moments::second_of_faces);
  body.D.assign(body.cells.boundary.size(), {});
  return body;
}

TEST(Amplification, AndMapAndWeightAreThoseOfTheTheory) {
  const std::vector<VoronoiBody> bodies{voronoi_body(box({1, 1, 1}), {4, 4, 4}, 0.25, 9, nothing),
                                        voronoi_body(box({1, 1, 1}), {4, 3, 4}, 0.25, 9, mixed),
                                        voronoi_body(l_block(), {4, 7, 3}, 0.2, 4, nothing), wedge()};
  for (const VoronoiBody& body : bodies) {
    const Discretization d = curved(body);
    const SecondDerivatives& found = d.second_order->derivatives;
    const Fits fits(body);
    double volume = 0.0;
    for (const double V : body.cells.volume) volume += V;
    const double size = std::cbrt(volume / static_cast<double>(body.X.size()));
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      const Fit expected = fits.at(a);
      EXPECT_NEAR(found.amplification[a], expected.amplification, 1e-7 * expected.amplification) << a;
      if (!found.resolved[a]) {
        EXPECT_EQ(found.weight[a], 0.0);
        continue;
      }
      EXPECT_NEAR(found.weight[a] * std::pow(size * size * expected.deviation, 8), 1.0, 1e-6) << a;
      for (int r = 0; r < 6; ++r)
        for (int k = 0; k < 9; ++k)
          EXPECT_NEAR(found.map[a][static_cast<std::size_t>(9 * r + k)], expected.map(r, k),
                      1e-8 * expected.map.norm());
    }
  }
}

/// Cells on either side of the limit are in one body.
TEST(Amplification, OfMoreThanTwelveIsNotResolved) {
  const VoronoiBody body = wedge();
  const Discretization d = curved(body);
  const SecondDerivatives& found = d.second_order->derivatives;
  const Fits fits(body);
  int just_below = 0, just_above = 0;
  for (std::size_t a = 0; a < body.X.size(); ++a) {
    const double amplification = fits.at(a).amplification;
    EXPECT_EQ(found.resolved[a] != 0, amplification <= 12.0) << a << ": " << amplification;
    just_below += amplification > 8.0 && amplification <= 12.0 ? 1 : 0;
    just_above += amplification > 12.0 && amplification < 24.0 ? 1 : 0;
  }
  EXPECT_GT(just_below, 0);
  EXPECT_GT(just_above, 0);
}

}  // namespace
}  // namespace tessera::test
