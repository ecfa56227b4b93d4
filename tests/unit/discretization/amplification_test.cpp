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
  double depth = 1.0;       // 1 at most, and where the stencil is narrow
  double mean_depth = 0.0;  // with the neighbours'
  double deepest = 0.0;     // the greatest of those within three rings of neighbours
  bool is_mean = false;

  bool is_resolved() const { return amplification <= 12.0 && deepest >= 0.6; }
};

/// How much the places s of particles along n tell of second derivatives: the mean square of what is left of s^2 when
/// the best linear function of s is taken off.
double depth_along(const Eigen::Vector3d& n, const Eigen::MatrixX3d& X) {
  Eigen::MatrixXd linear = Eigen::MatrixXd::Ones(X.rows(), 2);
  const Eigen::VectorXd s = X * n, squares = s.cwiseProduct(s);
  linear.col(1) = s;
  const Eigen::VectorXd best = linear.colPivHouseholderQr().solve(squares);
  return (squares - linear * best).squaredNorm() / static_cast<double>(X.rows());
}

/// In coordinates in which the cell is as wide in all directions, the least of six directions across the longest axis,
/// each 30 degrees from the next.
double depth_of(const std::vector<Vec3>& branches, const Mat3& second_moment) {
  Eigen::Matrix3d M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) M(i, j) = 12.0 * second_moment(i, j);
  const Eigen::Matrix3d to_cells = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(M).operatorInverseSqrt();
  Eigen::MatrixX3d X = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(branches.size()) + 1, 3);  // the particle last
  for (std::size_t i = 0; i < branches.size(); ++i)
    X.row(static_cast<Eigen::Index>(i)) = to_cells * Eigen::Vector3d(branches[i].x, branches[i].y, branches[i].z);
  const Eigen::MatrixX3d centred = X.rowwise() - X.colwise().mean();
  const Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred.transpose() * centred).eigenvectors();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::acos(-1.0) / 6.0;
    least = std::min(least, depth_along(std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1), X));
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
    for (std::size_t a = 0; a < body.X.size(); ++a) fits_.push_back(best(a));
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      double sum = fits_[a].depth;
      for (const std::size_t b : near_[a]) sum += fits_[b].depth;
      fits_[a].mean_depth = sum / static_cast<double>(1 + near_[a].size());
    }
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      std::set<std::size_t> seen = near_[a];
      for (const std::size_t b : beyond(a, 3)) seen.insert(b);
      seen.insert(a);
      for (const std::size_t b : seen) fits_[a].deepest = std::max(fits_[a].deepest, fits_[b].mean_depth);
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
    return fits_[a].is_resolved() ? std::pow(size_ * size_ * fits_[a].deviation, -5) : 0.0;
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

  /// Those within so many rings of neighbours but the first, nearest first.
  std::vector<std::size_t> beyond(std::size_t a, int rings) const {
    std::set<std::size_t> all = near_[a];
    for (int k = 1; k < rings; ++k)
      for (const std::size_t b : std::set<std::size_t>(all)) all.insert(near_[b].begin(), near_[b].end());
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
    if (refused_.contains(a)) {
      Fit none;
      none.depth = 0.0;
      return none;
    }
    if (is_inside(a)) {
      const std::vector<std::size_t> few = beyond(a, 2);
      for (std::size_t n = 0; n <= std::min<std::size_t>(12, few.size()); ++n) {
        if (divides(a, few, n)) continue;
        const Fit fit = over(a, {few.begin(), few.begin() + static_cast<std::ptrdiff_t>(n)});
        if (fit.amplification <= 6.0) return fit;
      }
    }
    const std::vector<std::size_t> more = beyond(a, at_boundary_[a] ? 2 : 3);
    std::size_t nearest = std::min<std::size_t>(at_boundary_[a] ? 30 : 54, more.size());
    while (divides(a, more, nearest)) ++nearest;
    Fit fit = over(a, {more.begin(), more.begin() + static_cast<std::ptrdiff_t>(nearest)});
    fit.is_mean = at_boundary_[a] || is_inside(a);
    const Mat3 second_moment = (1.0 / body_.cells.volume[a]) * to_mat3(body_.cells.second_moment[a]);
    fit.depth = std::min(1.0, depth_of(branches(a, stencil(a, beyond(a, 3))), second_moment));
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

/// So irregular that it is no matter of course whether they are three layers.
VoronoiBody hardly_layers() { return voronoi_body(box({12, 12, 3}), {12, 12, 3}, 0.4, 1, nothing); }

/// A lattice that is `stretch` times as wide in one direction. Two and a half times, the nearest twelve do not tell of
/// mixed derivatives in it, so cells take means away from the boundary too.
VoronoiBody stretched(double stretch) { return voronoi_body(box({6, 6, 5 * stretch}), {6, 6, 5}, 0.0, 1, nothing); }

/// Two cells have two faces in common, halves of one.
VoronoiBody with_divided_face() {
  VoronoiBody body = voronoi_body(box({1, 1, 1}), {5, 5, 5}, 0.2, 3, nothing);
  Cells& cells = body.cells;
  const auto k = std::find_if(cells.interior.begin(), cells.interior.end(),
                              [](const InteriorFace& f) { return f.a == 62 || f.b == 62; }) -
                 cells.interior.begin();
  const auto face = static_cast<std::size_t>(k);
  cells.interior[face].area = 0.5 * cells.interior[face].area;
  cells.interior_second_moment[face] *= 0.5;
  const InteriorFace half = cells.interior[face];
  const Symmetric3 second_moment = cells.interior_second_moment[face];
  cells.interior.insert(cells.interior.begin() + k, half);
  cells.interior_second_moment.insert(cells.interior_second_moment.begin() + k, second_moment);
  return body;
}

std::vector<VoronoiBody> bodies() {
  return {with_divided_face(),
          voronoi_body(box({1, 1, 1}), {4, 4, 4}, 0.25, 9, nothing),
          voronoi_body(box({1, 1, 1}), {6, 6, 6}, 0.45, 2, nothing),
          voronoi_body(box({1, 1, 1}), {5, 6, 5}, 0.0, 1, nothing),
          stretched(2.5),
          voronoi_body(box({1, 1, 1}), {4, 5, 4}, 0.25, 9, mixed),
          voronoi_body(l_block(), {4, 7, 3}, 0.2, 4, nothing),
          voronoi_body(l_block(), {8, 13, 4}, 0.2, 4, nothing),
          voronoi_body(box({3, 2, 1}), {6, 4, 2}, 0.15, 2, nothing),
          voronoi_body(box({3, 2, 1}), {6, 4, 2}, 0.35, 2, nothing),
          hardly_layers()};
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

/// Cells on either side of the limit of depth are in one body.
TEST(Depth, DecidesWhatIsResolved) {
  const VoronoiBody body = hardly_layers();
  const Discretization d = curved(body);
  const SecondDerivatives& found = d.second_order->derivatives;
  const Fits fits(body);
  int just_deep = 0, just_shallow = 0;
  for (std::size_t a = 0; a < body.X.size(); ++a) {
    const double depth = fits.at(a).deepest;
    EXPECT_EQ(found.resolved[a] != 0, depth >= 0.6) << a << ": " << depth;
    just_deep += depth >= 0.6 && depth < 0.65 ? 1 : 0;
    just_shallow += depth < 0.6 && depth > 0.55 ? 1 : 0;
  }
  EXPECT_GT(just_deep, 0);
  EXPECT_GT(just_shallow, 0);
}

/// Nor are cells with several faces in common; all others of that body are.
TEST(SecondDerivatives, OfCellsWithADividedFaceAreNotResolved) {
  const Discretization d = curved(with_divided_face());
  const std::vector<char>& resolved = d.second_order->derivatives.resolved;
  EXPECT_EQ(std::count(resolved.begin(), resolved.end(), 0), 2);
  EXPECT_EQ(resolved[62], 0);
}

/// Depth is not all: in a stretched lattice five layers of six by six are deep, but the nearest particles are in too
/// few of them.
TEST(Amplification, OfMoreThanTwelveIsNotResolved) {
  int below = 0, above = 0;
  for (const double stretch : {3.0, 3.5, 4.0, 4.5, 5.0}) {
    const VoronoiBody body = stretched(stretch);
    const Discretization d = curved(body);
    const SecondDerivatives& found = d.second_order->derivatives;
    const Fits fits(body);
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      if (fits.at(a).deepest < 0.6) continue;
      const double amplification = found.amplification[a];
      EXPECT_EQ(found.resolved[a] != 0, amplification <= 12.0) << stretch << ", " << a << ": " << amplification;
      below += amplification <= 12.0 && amplification > 6.0 ? 1 : 0;
      above += amplification > 12.0 && amplification < 24.0 ? 1 : 0;
    }
  }
  EXPECT_GT(below, 0);
  EXPECT_GT(above, 0);
}

}  // namespace
}  // namespace tessera::test
