#include "tessera/tessellation/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/surfaces.hpp"
#include "support/triangle_surfaces.hpp"
#include "tessera/base/error.hpp"
#include "tessera/geometry/surface_index.hpp"
#include "tessera/tessellation/surface_features.hpp"

namespace tessera::test {
namespace {

std::size_t patches(const SurfaceFeatures& features) {
  return static_cast<std::size_t>(1 + *std::max_element(features.patch.begin(), features.patch.end()));
}

TEST(SurfaceFeatures, AreSharpEdgesBetweenCorners) {
  const TriangleSurface box = with_one_side(box_surface({0, 0, 0}, {1, 2, 3}));
  const SurfaceFeatures features = surface_features(box, 40.0);
  EXPECT_EQ(features.lines.size(), 12U);
  for (const FeatureLine& line : features.lines) EXPECT_EQ(line.size(), 2U);
  EXPECT_EQ(patches(features), 6U);
}

/// Two sides of a ball meet at a ring without corners: one closed line.
TEST(SurfaceFeatures, AreLinesBetweenSides) {
  TriangleSurface ball = ball_surface(1.0, 12, 24);
  EXPECT_TRUE(surface_features(ball, 40.0).lines.empty());
  ball.side_names = {"below", "above"};
  for (Index t = 0; t < ball.size(); ++t) {
    const auto [a, b, c] = ball.corners(t);
    ball.side[static_cast<std::size_t>(t)] = a.z + b.z + c.z > 0.0 ? 1 : 0;
  }
  const SurfaceFeatures features = surface_features(ball, 40.0);
  ASSERT_EQ(features.lines.size(), 1U);
  EXPECT_EQ(features.lines[0].size(), 25U);
  EXPECT_EQ(features.lines[0].front(), features.lines[0].back());
  EXPECT_EQ(patches(features), 2U);
}

class SurfaceMeshes : public testing::Test {
  void SetUp() override {
    if (!has_surface_mesher()) GTEST_SKIP() << "built without a mesher";
  }
};

std::map<std::string, double> areas(const TetrahedralMesh& mesh) {
  std::map<std::string, double> sums;
  for (const BoundaryTriangle& t : mesh.boundary) {
    const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t.vertices[i])]; };
    sums[mesh.side_names[static_cast<std::size_t>(t.side)].front()] += 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
  }
  return sums;
}

double largest_distance(const TetrahedralMesh& mesh, const TriangleSurface& surface) {
  const SurfaceIndex index(surface);
  double distance = 0.0;
  for (const BoundaryTriangle& t : mesh.boundary)
    for (const Index v : t.vertices)
      distance = std::max(distance, index.nearest(mesh.points[static_cast<std::size_t>(v)]).distance);
  return distance;
}

TEST_F(SurfaceMeshes, AreExactOnPlaneSides) {
  const TriangleSurface box = turned(box_surface({0, 0, 0}, {1, 0.8, 0.5}), 0.7);
  const SurfaceMesh made = mesh_surface(box, {0.2});
  EXPECT_NEAR(made.volume, 0.4, 1e-13);
  EXPECT_LT(largest_distance(made.mesh, box), 1e-13);
  const auto sums = areas(made.mesh);
  EXPECT_NEAR(sums.at("-x"), 0.4, 1e-12);
  EXPECT_NEAR(sums.at("+y"), 0.5, 1e-12);
  EXPECT_NEAR(sums.at("+z"), 0.8, 1e-12);
  EXPECT_GT(made.smallest_angle, 0.0);
  EXPECT_GT(made.mesh.points.size(), 80U);
  EXPECT_LT(made.mesh.points.size(), 400U);
}

TEST_F(SurfaceMeshes, ApproachCurvedSides) {
  const TriangleSurface ball = ball_surface(1.0, 40, 80);
  double error = 0.0;
  for (const double spacing : {0.4, 0.2}) {
    const SurfaceMesh made = mesh_surface(ball, {spacing});
    EXPECT_LT(largest_distance(made.mesh, ball), 1e-12);
    const double e = 1.0 - made.volume / made.surface_volume;
    EXPECT_GT(e, 0.0);
    if (spacing == 0.4) error = e;
    EXPECT_TRUE(spacing == 0.4 || e < 0.6 * error) << e;
  }
  EXPECT_LT(error, 0.05);
}

TEST_F(SurfaceMeshes, FillSolidsWithHoles) {
  const TriangleSurface torus = torus_surface(1.0, 0.4, 48, 24);
  const SurfaceMesh made = mesh_surface(torus, {0.2});
  EXPECT_NEAR(made.volume / made.surface_volume, 1.0, 0.03);
  // Euler's number of a torus: V - E + F = 0 on its boundary, and E = 3 F / 2.
  std::vector<char> on_boundary(made.mesh.points.size(), 0);
  for (const BoundaryTriangle& t : made.mesh.boundary)
    for (const Index v : t.vertices) on_boundary[static_cast<std::size_t>(v)] = 1;
  const auto vertices = std::count(on_boundary.begin(), on_boundary.end(), 1);
  EXPECT_EQ(2 * vertices, static_cast<std::ptrdiff_t>(made.mesh.boundary.size()));
}

TEST_F(SurfaceMeshes, AreTheSameOnEveryCall) {
  const TriangleSurface torus = torus_surface(1.0, 0.4, 24, 10);
  const SurfaceMesh one = mesh_surface(torus, {0.3}), two = mesh_surface(torus, {0.3});
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.tetrahedra, two.mesh.tetrahedra);
}

TEST_F(SurfaceMeshes, RefuseMoreParticlesThanFit) {
  EXPECT_THROW(mesh_surface(ball_surface(1.0, 12, 24), {1e-4}), GeometryError);
}

TEST(SurfaceMesh, SaysWhatIsMissingWithoutAMesher) {
  if (has_surface_mesher()) GTEST_SKIP() << "there is one";
  try {
    mesh_surface(ball_surface(1.0, 6, 12), {0.3});
    FAIL();
  } catch (const GeometryError& e) {
    EXPECT_NE(std::string(e.what()).find("TESSERA_WITH_CGAL"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("mesh = \"part.msh\""), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace tessera::test
