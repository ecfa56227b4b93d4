#include <gtest/gtest.h>

#include "support/delaunay_reference.hpp"
#include "support/ghost_reference.hpp"
#include "support/small_bodies.hpp"
#include "tessera/discretization/ghosts.hpp"

namespace tessera::test {
namespace {

/// [D 27]: area vectors of the cluster's boundary triangles against shape functions, boundary and re-entrant edges
/// included.
TEST(GradientVectors, OfDelaunayClustersAreThoseOfTheirFaces) {
  for (const TetrahedralMesh& mesh :
       {tetrahedra(box({1, 1, 1}), {3, 3, 3}, 0.2, 8), tetrahedra(l_block(), {4, 10, 3}, 0.2, 5)}) {
    const DelaunayReference reference(mesh);
    const Discretization d = discretize_delaunay(mesh, {});
    double size = 0.0;
    for (const Vec3& B : d.bonds.B_ab) size = std::max(size, norm(B));
    for (Index a = 0; a < d.particles(); ++a) {
      const auto i = static_cast<std::size_t>(a);
      EXPECT_NEAR(d.volume[i], reference.V[i], 1e-13 * reference.V[i]);
      EXPECT_LT(norm(d.B_aa[i] - reference.B(i, i)), 1e-13 * size);
      EXPECT_EQ(static_cast<std::size_t>(d.bonds.end(a) - d.bonds.begin(a)) + 1, reference.near[i].size());
      for (std::size_t b : reference.near[i]) {
        if (b == i) continue;
        const Offset bond = d.bonds.find(a, static_cast<Index>(b));
        ASSERT_GE(bond, 0);
        EXPECT_LT(norm(d.bonds.B_ab[static_cast<std::size_t>(bond)] - reference.B(i, b)), 1e-13 * size);
        EXPECT_LT(norm(d.bonds.B_ba(a, bond) - reference.B(b, i)), 1e-13 * size);
      }
    }
  }
}

/// [V 7] for cells whose neighbours are all real: the bare gradient vectors.
TEST(GradientVectors, OfInnerVoronoiCellsAreThoseOfThePaper) {
  const VoronoiBody body = voronoi_body(box({1, 1, 1}), {4, 4, 4}, 0.3, 2, nothing);
  const GhostReference reference(body);
  const Discretization d = discretize(Method::variational, body);
  int inner = 0;
  for (std::size_t a = 0; a < body.X.size(); ++a) {
    const auto& near = reference.near[a];
    if (std::any_of(near.begin(), near.end(), [](const auto& n) { return n.ghost; })) continue;
    ++inner;
    for (const auto& n : near) {
      const Offset bond = d.bonds.find(static_cast<Index>(a), static_cast<Index>(n.particle));
      ASSERT_GE(bond, 0);
      EXPECT_LT(norm(d.bonds.B_ab[static_cast<std::size_t>(bond)] - n.B), 1e-15);
    }
  }
  EXPECT_GE(inner, 8);
}

/// [V 61]: B_ab = - dV_b / dX_a, by differences of the cells' volumes.
TEST(GradientVectors, AreDerivativesOfCellVolumes) {
  const Solid solid = box({1, 1, 1});
  const VoronoiBody body = voronoi_body(solid, {3, 3, 3}, 0.25, 6, nothing);
  const GhostReference reference(body);
  const std::size_t a = 13;  // the middle one
  const double h = 1e-5;
  for (int i = 0; i < 3; ++i) {
    std::vector<Vec3> plus = body.X, minus = body.X;
    plus[a][i] += h;
    minus[a][i] -= h;
    const Cells more = voronoi_cells(plus, solid), less = voronoi_cells(minus, solid);
    for (const auto& n : reference.near[a]) {
      ASSERT_FALSE(n.ghost);
      const double slope = (more.volume[n.particle] - less.volume[n.particle]) / (2.0 * h);
      EXPECT_NEAR(n.B[i], -slope, 1e-8);
    }
  }
}

std::vector<GhostNeighbour> neighbours(const GhostReference& r, std::size_t a) {
  std::vector<GhostNeighbour> list;
  for (const auto& n : r.near[a]) list.push_back({n.X, n.B});
  return list;
}

/// K of [V 18] is half the second derivative of the sum of squares in [V 15].
TEST(GhostCoefficients, LeastSquaresMatrixIsTheHessianOfTheSumOfSquares) {
  const GhostReference r(voronoi_body(box({1, 1, 1}), {3, 3, 3}, 0.25, 9, nothing));
  for (std::size_t a : {0U, 1U, 4U}) {
    const auto n = r.near[a].size();
    const auto sum_of_squares = [&](const std::vector<double>& x) {  // one component is as good as three
      double s = 0.0;
      for (std::size_t c = 0; c < n; ++c) {
        double rest = x[c];
        for (std::size_t d = 0; d < n; ++d) rest -= r.H(a, r.near[a][c], r.near[a][d]) * x[d];
        s += rest * rest;
      }
      return s;
    };
    const Eigen::MatrixXd K = least_squares_matrix(branch_expansion(neighbours(r, a), r.V[a]));
    for (std::size_t b = 0; b < n; ++b)
      for (std::size_t c = 0; c < n; ++c) {
        // The sum is quadratic, so unit steps give its second derivative exactly.
        std::vector<double> both(n, 0.0), only_b(n, 0.0), only_c(n, 0.0);
        both[b] += 1.0, both[c] += 1.0, only_b[b] = 1.0, only_c[c] = 1.0;
        const double second = sum_of_squares(both) - sum_of_squares(only_b) - sum_of_squares(only_c);
        EXPECT_NEAR(K(GhostReference::index(b), GhostReference::index(c)), 0.5 * second, 1e-12);
      }
  }
}

/// K' of [V 22] against minimisation by orthogonalisation; free, symmetric and prescribed ghosts at once.
TEST(GhostCoefficients, MinimiseTheSumOfSquares) {
  const GhostReference r(voronoi_body(box({1, 1, 1}), {3, 3, 3}, 0.25, 9, mixed));
  int compared = 0;
  for (std::size_t a = 0; a < r.X.size(); ++a) {
    std::vector<int> free;
    for (std::size_t b = 0; b < r.near[a].size(); ++b)
      if (!GhostReference::is_known(r.near[a][b])) free.push_back(static_cast<int>(b));
    if (free.empty()) continue;
    const Eigen::MatrixXd K =
        ghost_coefficients(least_squares_matrix(branch_expansion(neighbours(r, a), r.V[a])), free);
    for (std::size_t i = 0; i < free.size(); ++i, ++compared)
      EXPECT_LT((K.row(GhostReference::index(i)) - r.K_prime[a].row(free[i])).norm(), 1e-12);
  }
  EXPECT_GT(compared, 40);
}

}  // namespace
}  // namespace tessera::test
