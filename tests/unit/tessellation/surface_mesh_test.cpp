#include "tessera/tessellation/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
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

/// By each of the two meshers; Gmsh puts chords of a spacing on curved sides, CGAL shorter ones where they bend.
class SurfaceMeshes : public testing::TestWithParam<Mesher> {
  void SetUp() override {
    if (GetParam() == Mesher::cgal && !has_cgal_mesher()) GTEST_SKIP() << "built without CGAL's mesher";
    if (GetParam() == Mesher::gmsh && !has_gmsh()) GTEST_SKIP() << "the program gmsh is not installed";
  }

 protected:
  static SurfaceMesh mesh(const TriangleSurface& surface, double spacing,
                          std::function<double(const Vec3&)> size = {}) {
    return mesh_surface(surface, {.spacing = spacing, .mesher = GetParam(), .size = std::move(size)});
  }
};

INSTANTIATE_TEST_SUITE_P(By, SurfaceMeshes, testing::Values(Mesher::cgal, Mesher::gmsh),
                         [](const auto& test) { return std::string(test.param == Mesher::gmsh ? "gmsh" : "cgal"); });

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

TEST_P(SurfaceMeshes, AreExactOnPlaneSides) {
  const TriangleSurface box = turned(box_surface({0, 0, 0}, {1, 0.8, 0.5}), 0.7);
  const SurfaceMesh made = mesh(box, 0.2);
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

TEST_P(SurfaceMeshes, ApproachCurvedSides) {
  const TriangleSurface ball = ball_surface(1.0, 40, 80);
  double error = 0.0;
  for (const double spacing : {0.4, 0.2}) {
    const SurfaceMesh made = mesh(ball, spacing);
    EXPECT_LT(largest_distance(made.mesh, ball), 1e-12);
    const double e = 1.0 - made.volume / made.surface_volume;
    EXPECT_GT(e, 0.0);
    if (spacing == 0.4) error = e;
    EXPECT_TRUE(spacing == 0.4 || e < 0.6 * error) << e;
  }
  EXPECT_LT(error, GetParam() == Mesher::gmsh ? 0.06 : 0.05);
}

TEST_P(SurfaceMeshes, FillSolidsWithHoles) {
  const TriangleSurface torus = torus_surface(1.0, 0.4, 48, 24);
  const SurfaceMesh made = mesh(torus, 0.2);
  EXPECT_NEAR(made.volume / made.surface_volume, 1.0, 0.03);
  // Euler's number of a torus: V - E + F = 0 on its boundary, and E = 3 F / 2.
  std::vector<char> on_boundary(made.mesh.points.size(), 0);
  for (const BoundaryTriangle& t : made.mesh.boundary)
    for (const Index v : t.vertices) on_boundary[static_cast<std::size_t>(v)] = 1;
  const auto vertices = std::count(on_boundary.begin(), on_boundary.end(), 1);
  EXPECT_EQ(2 * vertices, static_cast<std::ptrdiff_t>(made.mesh.boundary.size()));
}

TEST_P(SurfaceMeshes, AreTheSameOnEveryCall) {
  const TriangleSurface torus = torus_surface(1.0, 0.4, 24, 10);
  const SurfaceMesh one = mesh(torus, 0.3), two = mesh(torus, 0.3);
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.tetrahedra, two.mesh.tetrahedra);
}

TEST_P(SurfaceMeshes, RefuseMoreParticlesThanFit) {
  EXPECT_THROW(mesh(ball_surface(1.0, 12, 24), 1e-4), GeometryError);
}

/// A line between sides in a plane is no sharp edge, but kept.
TEST_P(SurfaceMeshes, KeepLinesBetweenSidesInAPlane) {
  TriangleSurface box = box_surface({0, 0, 0}, {1, 0.8, 0.5});
  for (Index t = 0; t < box.size(); ++t) {
    const auto [a, b, c] = box.corners(t);
    if (a.z + b.z + c.z < 1.5) continue;  // the top is two triangles
    box.side[static_cast<std::size_t>(t)] = static_cast<Index>(box.side_names.size());
    box.side_names.push_back(t % 2 == 0 ? "even" : "odd");
  }
  const auto sums = areas(mesh(box, 0.2).mesh);
  EXPECT_NEAR(sums.at("even"), 0.4, 1e-12);
  EXPECT_NEAR(sums.at("odd"), 0.4, 1e-12);
}

TEST_P(SurfaceMeshes, LeaveCavitiesEmpty) {
  TriangleSurface hollow = box_surface({0, 0, 0}, {1, 1, 1});
  const TriangleSurface hole = box_surface({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7});
  const auto first = static_cast<Index>(hollow.vertices.size());
  hollow.vertices.insert(hollow.vertices.end(), hole.vertices.begin(), hole.vertices.end());
  for (const Triangle& t : hole.triangles) {
    hollow.triangles.push_back({first + t[0], first + t[2], first + t[1]});
    hollow.side.push_back(0);
  }
  EXPECT_NEAR(mesh(hollow, 0.2).volume, 1.0 - 0.064, 1e-12);
}

TEST_P(SurfaceMeshes, FollowALocalSize) {
  const TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceMesh made = mesh(box, 0.2, [](const Vec3& X) { return 0.08 + 0.24 * X.x; });
  const auto fine =
      std::count_if(made.mesh.points.begin(), made.mesh.points.end(), [](const Vec3& X) { return X.x < 0.25; });
  const auto coarse =
      std::count_if(made.mesh.points.begin(), made.mesh.points.end(), [](const Vec3& X) { return X.x > 0.75; });
  EXPECT_GT(fine, 5 * coarse);
  EXPECT_NEAR(made.volume, 1.0, 1e-12);
}

/// Sets PATH while it lives.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) : before_(std::getenv("PATH")) { setenv("PATH", path.c_str(), 1); }
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

std::string message_of(const SurfaceMeshSpec& spec) {
  try {
    mesh_surface(ball_surface(1.0, 6, 12), spec);
  } catch (const GeometryError& e) {
    return e.what();
  }
  return "no error";
}

TEST(SurfaceMesh, SaysWhatIsMissingWithoutAMesher) {
  const SearchPath nowhere("/nonexistent");
  EXPECT_NE(message_of({.spacing = 0.3, .mesher = Mesher::gmsh}).find("apt-get install gmsh"), std::string::npos);
  if (has_cgal_mesher()) return;
  EXPECT_NE(message_of({.spacing = 0.3, .mesher = Mesher::cgal}).find("TESSERA_WITH_CGAL"), std::string::npos);
  const std::string text = message_of({.spacing = 0.3});
  for (const char* cure : {"TESSERA_WITH_CGAL", "apt-get install gmsh", "mesh = \"part.msh\""})
    EXPECT_NE(text.find(cure), std::string::npos) << text;
}

/// A program that calls itself gmsh and does what `script` says.
class FalseGmsh {
 public:
  explicit FalseGmsh(const std::string& script)
      : folder_(testing::TempDir() + "false-gmsh-" + testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ + "/gmsh") << "#!/bin/sh\n" << script;
    std::filesystem::permissions(folder_ + "/gmsh", std::filesystem::perms::owner_all);
  }
  ~FalseGmsh() { std::filesystem::remove_all(folder_); }
  std::string path() const { return folder_ + ":/usr/bin:/bin"; }

 private:
  std::string folder_;
};

TEST(SurfaceMesh, TellsWhatGmshComplainsOf) {
  const FalseGmsh gmsh("echo 'Info : so far'\necho 'Error   : Surfaces overlap' >&2\necho 'Error : ----'\nexit 1\n");
  const SearchPath path(gmsh.path());
  const std::string text = message_of({.spacing = 0.3, .mesher = Mesher::gmsh});
  EXPECT_NE(text.find("ended with status 1"), std::string::npos) << text;
  EXPECT_NE(text.find("saying: Surfaces overlap;"), std::string::npos) << text;
}

TEST(SurfaceMesh, RefusesAGmshThatLeavesNoMesh) {
  const FalseGmsh gmsh("exit 0\n");
  const SearchPath path(gmsh.path());
  const std::string text = message_of({.spacing = 0.3, .mesher = Mesher::gmsh});
  EXPECT_NE(text.find("left no mesh"), std::string::npos) << text;
}

TEST(SurfaceMesh, LeavesNoTemporaryFilesOfGmsh) {
  const FalseGmsh gmsh("ls \"$GMSH_HOME\" > \"" + testing::TempDir() + "seen\"\nexit 1\n");
  const SearchPath path(gmsh.path());
  const std::string home = testing::TempDir() + "meshes";
  std::filesystem::create_directories(home);
  setenv("TMPDIR", home.c_str(), 1);
  message_of({.spacing = 0.3, .mesher = Mesher::gmsh});
  unsetenv("TMPDIR");
  std::ifstream seen(testing::TempDir() + "seen");
  const std::string files((std::istreambuf_iterator<char>(seen)), {});
  EXPECT_NE(files.find("surface.msh"), std::string::npos) << files;
  EXPECT_TRUE(std::filesystem::is_empty(home));
  std::filesystem::remove_all(home);
}

}  // namespace
}  // namespace tessera::test
