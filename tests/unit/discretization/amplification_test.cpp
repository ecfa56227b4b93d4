#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "support/consistent_reference.hpp"
#include "support/quadratic_weights.hpp"
#include "tessera/discretization/second_derivatives.hpp"

namespace tessera::test {
namespace {

using Weights = std::map<std::size_t, std::array<double, 6>>;  // of particles, in second derivatives at one of them

/// Second derivatives (24) by the words of the theory: stencils by plain search, weights by their definition.
struct Fit {
  Weights W;  // with the particle itself
  double deviation = std::numeric_limits<double>::infinity(), amplification = deviation;
  double depth = 2.0;           // 2 at most, and inside
  double mean_certainty = 0.0;  // depth over amplification, with the neighbours'
  bool is_mean = false;

  bool is_resolved() const { return amplification <= 12.0 && mean_certainty >= 0.25; }
};

/// How much the places s of particles along n tell of second derivatives: the mean square of what is left of s^2 when
/// the best linear function of s is taken off, over the square of the mean s^2 of the nearest ones.
double depth_along(const Vec3& n, const std::vector<Vec3>& branches, std::size_t nearest) {
  const auto count = static_cast<Eigen::Index>(branches.size()) + 1;
  Eigen::MatrixXd linear = Eigen::MatrixXd::Ones(count, 2);
  Eigen::VectorXd s = Eigen::VectorXd::Zero(count);  // the last one is the particle itself
  for (std::size_t i = 0; i < branches.size(); ++i) s(static_cast<Eigen::Index>(i)) = dot(branches[i], n);
  linear.col(1) = s;
  const Eigen::VectorXd squares = s.cwiseProduct(s);
  const Eigen::VectorXd best = linear.colPivHouseholderQr().solve(squares);
  const double mean = squares.head(static_cast<Eigen::Index>(nearest)).mean();
  return (squares - linear * best).squaredNorm() / static_cast<double>(count) / (mean * mean);
}

/// The least of six directions across the longest axis, each 30 degrees from the next.
double depth_of(const std::vector<Vec3>& branches, std::size_t nearest) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
  for (const Vec3& X : branches) K += Eigen::Vector3d(X.x, X.y, X.z) * Eigen::Vector3d(X.x, X.y, X.z).transpose();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(K).eigenvectors();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::acos(-1.0) / 6.0;
    const Eigen::Vector3d n = std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1);
    least = std::min(least, depth_along({n(0), n(1), n(2)}, branches, nearest));
  }
  return least;
}

class Fits {
 public:
  explicit Fits(const VoronoiBody& body) : body_(body), near_(body.X.size()), at_boundary_(body.X.size()) {
    std::set<std::pair<Index, Index>> pairs;
    for (const InteriorFace& f : body.cells.interior) {
      const auto a = static_cast<std::size_t>(f.a), b = static_cast<std::size_t>(f.b);
      near_[a].insert(b);
      near_[b].insert(a);
      if (!pairs.insert(std::minmax(f.a, f.b)).second) refused_.insert(a), refused_.insert(b);
    }
    for (const BoundaryFace& f : body.cells.boundary) at_boundary_[static_cast<std::size_t>(f.owner)] = true;
    double volume = 0.0;
    for (const double V : body.cells.volume) volume += V;
    size_ = std::cbrt(volume / static_cast<double>(body.X.size()));
    for (std::size_t a = 0; a < body.X.size(); ++a) fits_.push_back(refused_.contains(a) ? Fit{} : best(a));
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      double sum = fits_[a].depth / fits_[a].amplification;
      for (const std::size_t b : near_[a]) sum += fits_[b].depth / fits_[b].amplification;
      fits_[a].mean_certainty = sum / static_cast<double>(1 + near_[a].size());
    }
  }

  const Fit& at(std::size_t a) const { return fits_[a]; }
  bool at_boundary(std::size_t a) const { return at_boundary_[a]; }
  /// Neither at the boundary nor a neighbour of a cell that is.
  bool is_inside(std::size_t a) const {
    return !at_boundary_[a] &&
           std::none_of(near_[a].begin(), near_[a].end(), [&](std::size_t b) { return at_boundary_[b]; });
  }

  double weight(std::size_t a) const {
    return fits_[a].is_resolved() ? std::pow(size_ * size_ * fits_[a].deviation, -8) : 0.0;
  }

  /// Of the second derivatives that the cell uses.
  Weights in_cell(std::size_t a) const {
    if (!fits_[a].is_mean) return fits_[a].W;
    std::set<std::size_t> cells = near_[a];
    cells.insert(a);
    double sum = 0.0;
    Weights mean;
    for (const std::size_t b : cells) sum += weight(b);
    for (const std::size_t b : cells)
      if (fits_[b].is_resolved())
        for (const auto& [c, W] : fits_[b].W)
          for (std::size_t r = 0; r < 6; ++r) mean[c][r] += weight(b) / sum * W[r];
    return mean;
  }

 private:
  double distance(std::size_t a, std::size_t b) const { return norm(body_.X[b] - body_.X[a]); }

  /// Neighbours of neighbours, nearest first.
  std::vector<std::size_t> beyond(std::size_t a) const {
    std::set<std::size_t> all;
    for (const std::size_t b : near_[a]) all.insert(near_[b].begin(), near_[b].end());
    std::vector<std::size_t> sorted;
    for (const std::size_t c : all)
      if (c != a && !near_[a].contains(c)) sorted.push_back(c);
    std::sort(sorted.begin(), sorted.end(),
              [&](std::size_t c, std::size_t e) { return distance(a, c) < distance(a, e); });
    return sorted;
  }

  /// Are the first n of the particles as far as the next one?
  bool divides(std::size_t a, const std::vector<std::size_t>& more, std::size_t n) const {
    return n > 0 && n < more.size() && distance(a, more[n]) < (1.0 + 1e-6) * distance(a, more[n - 1]);
  }

  Fit best(std::size_t a) const {
    const std::vector<std::size_t> more = beyond(a);
    if (is_inside(a))
      for (std::size_t n = 0; n <= std::min<std::size_t>(12, more.size()); ++n) {
        if (divides(a, more, n)) continue;
        const Fit fit = over(a, {more.begin(), more.begin() + static_cast<std::ptrdiff_t>(n)});
        if (fit.amplification <= 6.0) return fit;
      }
    std::size_t nearest = std::min<std::size_t>(34, more.size());
    while (divides(a, more, nearest)) ++nearest;
    Fit fit = over(a, {more.begin(), more.begin() + static_cast<std::ptrdiff_t>(nearest)});
    fit.is_mean = at_boundary_[a] || is_inside(a);
    fit.depth = std::min(2.0, depth_of(branches(a, stencil(a, more)), near_[a].size()));
    return fit;
  }

  std::vector<std::size_t> stencil(std::size_t a, const std::vector<std::size_t>& more) const {
    std::vector<std::size_t> all(near_[a].begin(), near_[a].end());
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::vector<Vec3> branches(std::size_t a, const std::vector<std::size_t>& particles) const {
    std::vector<Vec3> all;
    for (const std::size_t b : particles) all.push_back(body_.X[b] - body_.X[a]);
    return all;
  }

  Fit over(std::size_t a, const std::vector<std::size_t>& more) const {
    const std::vector<std::size_t> particles = stencil(a, more);
    const std::vector<std::array<double, 6>> W = quadratic_weights(branches(a, particles));
    Fit fit;
    if (W.empty()) return fit;
    for (std::size_t i = 0; i < W.size(); ++i)
      for (std::size_t r = 0; r < 6; ++r) fit.W[particles[i]][r] += W[i][r], fit.W[a][r] -= W[i][r];
    double variance = 0.0, square = 0.0;
    for (const auto& [b, w] : fit.W)
      variance += w[0] * w[0] + w[3] * w[3] + w[5] * w[5] + 2.0 * (w[1] * w[1] + w[2] * w[2] + w[4] * w[4]);
    for (const std::size_t b : near_[a]) square += distance(a, b) * distance(a, b);
    fit.deviation = std::sqrt(variance);
    fit.amplification = fit.deviation * square / static_cast<double>(near_[a].size());
    return fit;
  }

  const VoronoiBody& body_;
  std::vector<std::set<std::size_t>> near_;
  std::vector<bool> at_boundary_;
  std::set<std::size_t> refused_;
  double size_ = 0.0;
  std::vector<Fit> fits_;
};

Discretization curved(const VoronoiBody& body) {
  return discretize(Method::consistent, body, Integration::second_order);
}

/// Three layers of which two come together along x: what they tell of the second derivatives across becomes less, until
/// they are as good as two.
VoronoiBody wedge() {
  const Solid solid = box({9, 4, 3});
  VoronoiBody body = voronoi_body(solid, {9, 4, 3}, 0.1, 5, nothing);
  for (Vec3& X : body.X) {
    const double apart = 1.0 - 0.115 * X.x;
    X.z = X.z < 1.0 ? 0.5 : X.z < 2.0 ? 2.5 - apart : 2.5;
  }
  body.cells = voronoi_cells(body.X, solid, Moments::second_of_faces);
  body.D.assign(body.cells.boundary.size(), {});
  return body;
}

/// A lattice two and a half times as wide in one direction: the nearest twelve do not tell of mixed derivatives in it,
/// so cells take means away from the boundary too.
VoronoiBody stretched() { return voronoi_body(box({6, 6, 12.5}), {6, 6, 5}, 0.0, 1, nothing); }

std::vector<VoronoiBody> bodies() {
  return {voronoi_body(box({1, 1, 1}), {4, 4, 4}, 0.25, 9, nothing),
          voronoi_body(box({1, 1, 1}), {6, 6, 6}, 0.45, 2, nothing),
          voronoi_body(box({1, 1, 1}), {5, 6, 5}, 0.0, 1, nothing),
          stretched(),
          voronoi_body(box({1, 1, 1}), {4, 3, 4}, 0.25, 9, mixed),
          voronoi_body(l_block(), {4, 7, 3}, 0.2, 4, nothing),
          voronoi_body(box({3, 2, 1}), {6, 4, 2}, 0.15, 2, nothing),
          voronoi_body(box({3, 2, 1}), {6, 4, 2}, 0.35, 2, nothing),
          wedge()};
}

/// Those of all particles but the one itself, as one matrix.
template <class Terms>
void expect_terms(const Terms& found, const Weights& expected, std::size_t a) {
  double size = 0.0;
  for (const auto& [b, W] : expected)
    for (const double w : W) size = std::max(size, std::abs(w));
  std::map<std::size_t, Symmetric3> of;
  for (const CurvatureTerm& t : found) of[static_cast<std::size_t>(t.particle)] += t.W;
  EXPECT_FALSE(of.contains(a));
  for (const auto& [b, W] : expected) {
    if (b == a) continue;
    const Symmetric3 w = of[b];
    const std::array<double, 6> all{w.xx, w.xy, w.xz, w.yy, w.yz, w.zz};
    for (std::size_t r = 0; r < 6; ++r) EXPECT_NEAR(all[r], W[r], 1e-9 * size) << a << ", " << b;
  }
  for (const auto& [b, w] : of) EXPECT_TRUE(expected.contains(b)) << a << ", " << b;
}

TEST(Amplification, AndFitAndWeightAreThoseOfTheTheory) {
  int few = 0, more = 0, wide = 0, mean_inside = 0;
  for (const VoronoiBody& body : bodies()) {
    const Discretization d = curved(body);
    const SecondDerivatives& found = d.second_order->derivatives;
    const Fits fits(body);
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      const Fit& expected = fits.at(a);
      if (expected.amplification < 1e3)
        EXPECT_NEAR(found.amplification[a], expected.amplification, 1e-8 * expected.amplification) << a;
      else
        EXPECT_GT(found.amplification[a], 0.99e3) << a;
      EXPECT_EQ(found.resolved[a] != 0, expected.is_resolved()) << a;
      EXPECT_EQ(found.averaged[a] != 0, expected.is_mean && expected.is_resolved()) << a;
      const auto row = static_cast<Index>(a);
      if (!expected.is_resolved()) {
        EXPECT_EQ(found.weight[a], 0.0);
        EXPECT_TRUE(curvature(d, found, row).empty() && cell_curvature(d, found, row).empty()) << a;
        continue;
      }
      EXPECT_NEAR(found.weight[a] / fits.weight(a), 1.0, 1e-7) << a;
      expect_terms(curvature(d, found, row), expected.W, a);
      expect_terms(cell_curvature(d, found, row), fits.in_cell(a), a);
      if (fits.is_inside(a))
        (expected.is_mean ? mean_inside : found.far.row(row).empty() ? few : more) += 1;
      else if (!fits.at_boundary(a))
        ++wide;
    }
  }
  EXPECT_GT(few, 0);
  EXPECT_GT(more, 0);
  EXPECT_GT(wide, 0);
  EXPECT_GT(mean_inside, 0);
}

/// Cells on either side of the limit of depth over amplification are in one body.
TEST(Amplification, OverDepthOfMoreThanFourIsNotResolved) {
  const VoronoiBody body = wedge();
  const Discretization d = curved(body);
  const SecondDerivatives& found = d.second_order->derivatives;
  const Fits fits(body);
  int just_sure = 0, just_unsure = 0;
  for (std::size_t a = 0; a < body.X.size(); ++a) {
    const double amplification = fits.at(a).amplification, certainty = fits.at(a).mean_certainty;
    EXPECT_EQ(found.resolved[a] != 0, amplification <= 12.0 && certainty >= 0.25) << a << ": " << amplification;
    if (found.amplification[a] > 12.0) continue;
    just_sure += certainty >= 0.25 && certainty < 0.35 ? 1 : 0;
    just_unsure += certainty < 0.25 && certainty > 0.15 ? 1 : 0;
  }
  EXPECT_GT(just_sure, 0);
  EXPECT_GT(just_unsure, 0);
}

}  // namespace
}  // namespace tessera::test
