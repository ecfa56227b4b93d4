#include "tessera/discretization/cell_measure.hpp"

#include <gtest/gtest.h>

#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

double size_of(const Mat3& m) { return std::sqrt(contract(m, m)); }

/// Volume, first and second moment about the origin of all regions together.
struct Sums {
  double volume = 0.0;
  Vec3 first;
  Symmetric3 second;
};

Sums sums_of(const Discretization& d) {
  Sums s;
  for (std::size_t a = 0; a < d.X.size(); ++a) {
    const double V = d.volume[a];
    const Vec3 C = d.measure->centroid[a];
    s.volume += V;
    s.first += V * C;
    s.second += V * (d.measure->second_moment[a] + square(C));
  }
  return s;
}

class CellMeasureOf : public testing::TestWithParam<Method> {};

/// The regions cover the body once: their moments add up to its own.
TEST_P(CellMeasureOf, CoversTheBody) {
  const Discretization d = discretize(GetParam(), box({1, 2, 3}), {3, 4, 5}, 0.25, 2, nothing, Integration::cell);
  const Sums s = sums_of(d);
  EXPECT_NEAR(s.volume, 6.0, 1e-12);
  EXPECT_LT(norm(s.first - 6.0 * Vec3{0.5, 1, 1.5}), 1e-12);
  const Mat3 expected = 6.0 * (outer({0.5, 1, 1.5}, {0.5, 1, 1.5}) + (1.0 / 12.0) * diagonal(1, 4, 9));
  EXPECT_LT(size_of(to_mat3(s.second) - expected), 1e-12 * size_of(expected));
}

/// A linear field of tensors, known at the centroids, is found at all six points.
TEST_P(CellMeasureOf, GradientsOfALinearFieldAreExact) {
  const Discretization d = discretize(GetParam(), box({1, 1, 1}), {3, 3, 3}, 0.3, 4, nothing, Integration::cell);
  const CellGradients g = cell_gradients(d);
  EXPECT_EQ(g.unresolved, 0);
  const Vec3 slope{0.3, -0.7, 1.1};
  for (Index a = 0; a < d.particles(); ++a) {
    Vec3 G;
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i) {
      const auto bond = static_cast<std::size_t>(i);
      if (d.bonds.area_over_length[bond] == 0.0) continue;
      const Vec3 C_ab = d.measure->centroid[static_cast<std::size_t>(d.bonds.neighbour[bond])] -
                        d.measure->centroid[static_cast<std::size_t>(a)];
      G += (dot(slope, C_ab) / norm2(C_ab)) * C_ab;
    }
    const auto k = static_cast<std::size_t>(a);
    const Mat3 p = cubature_points(d.measure->second_moment[k]);
    EXPECT_LT(norm(transpose(g.to_points[k]) * G - transpose(p) * slope), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CellMeasureOf, testing::Values(Method::delaunay, Method::consistent),
                         [](const auto& method) { return name_of(method.param); });

/// Moments of the quarter of one tetrahedron that is nearest to a corner, from the six tetrahedra it consists of.
TEST(DualCells, OfOneTetrahedron) {
  TetrahedralMesh mesh;
  mesh.points = {{0.1, 0, 0}, {1.3, 0.2, 0}, {0.2, 0.9, 0.1}, {0.3, 0.1, 0.8}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  const CellMeasure m = measure_of_dual_cells(mesh);
  const std::vector<Vec3>& X = mesh.points;
  for (std::size_t a = 0; a < 4; ++a) {
    Vec3 first;
    Symmetric3 second;
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) {
        if (j == a || k == a || j == k) continue;
        const std::array<Vec3, 4> corner{X[a], 0.5 * (X[a] + X[j]), (1.0 / 3.0) * (X[a] + X[j] + X[k]),
                                         0.25 * (X[0] + X[1] + X[2] + X[3])};
        const Vec3 sum = corner[0] + corner[1] + corner[2] + corner[3];
        first += (1.0 / 24.0) * sum;
        for (const Vec3& c : corner) second += (1.0 / 120.0) * square(c);
        second += (1.0 / 120.0) * square(sum);
      }
    EXPECT_LT(norm(m.centroid[a] - first), 1e-14);
    EXPECT_LT(size_of(to_mat3(m.second_moment[a] - (second - square(first)))), 1e-14);
  }
}

TEST(CubaturePoints, HaveTheSecondMoment) {
  const Symmetric3 M{0.3, 0.1, -0.05, 0.2, 0.02, 0.4};
  const Mat3 p = cubature_points(M);
  EXPECT_LT(size_of((1.0 / 3.0) * (p * transpose(p)) - to_mat3(M)), 1e-15);
  EXPECT_LT(size_of(p - transpose(p)), 1e-15);
}

/// In a slab one cell thick nothing tells how F varies across it.
TEST(CellGradients, LeaveOutDirectionsWithoutNeighbours) {
  const Constrain in_plane = [](const Vec3&, const Vec3& N) { return std::abs(N.z) > 0.5 ? outer(N, N) : Mat3{}; };
  const Discretization d =
      discretize(Method::consistent, box({1, 1, 0.25}), {4, 4, 1}, 0.0, 1, in_plane, Integration::cell);
  const CellGradients g = cell_gradients(d);
  EXPECT_EQ(g.unresolved, 16);
  for (const Mat3& A : g.to_points) {
    EXPECT_LT(norm(A * Vec3{0, 0, 1}), 1e-12);
    EXPECT_GT(norm(A * Vec3{1, 0, 0}), 0.05);
  }
}

}  // namespace
}  // namespace tessera::test
