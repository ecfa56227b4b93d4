#include <gtest/gtest.h>

#include <map>

#include "surface_helpers.hpp"
#include "tessera/base/error.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/surface_primitives.hpp"
#include "tessera/geometry/surface_transform.hpp"
#include "tessera/tessellation/surface_circumcenter.hpp"
#include "tessera/tessellation/surface_dual_cell.hpp"
#include "tessera/tessellation/surface_fence.hpp"
#include "tessera/tessellation/surface_planes.hpp"

namespace tessera::test {
namespace {

/// Points and, last, a tetrahedron far around them.
std::vector<Vec3> surrounded(std::vector<Vec3> points) {
  for (const Vec3& way : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}})
    points.push_back(100.0 * way);
  return points;
}

std::vector<Vec3> cube_lattice(int n, double spacing, double jitter) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        points.push_back(spacing * Vec3{i + move(random), j + move(random), k + move(random)});
  return points;
}

/// Every corner, named by its four generators, occurs in the cells of all four, with the same bits.
TEST(DualCells, AgreeOnTheirCorners) {
  for (const double spacing : {0.25, 0.1})
    for (const double jitter : {0.0, 1e-15, 0.3}) {
      const std::vector<Vec3> points = cube_lattice(5, spacing, jitter);
      const std::vector<Vec3> generators = surrounded(points);
      const PointGrid grid = grid_of(generators, spacing);
      DualCellCutter cutter(generators, grid);
      std::map<DualCell::Name, std::pair<Vec3, int>> corners;
      const auto n = static_cast<Index>(points.size());
      for (Index a = 0; a < n; ++a) {
        const DualCell& cell = cutter.cut(a);
        std::size_t uses = 0;
        for (const DualCell::Corner& corner : cell.corners) {
          const auto [it, is_new] = corners.try_emplace(corner.name, corner.X, 0);
          EXPECT_EQ(it->second.first, corner.X);
          ++it->second.second;
        }
        for (Index f = 0; f < cell.faces(); ++f) uses += cell.face(f).size();
        EXPECT_EQ(uses, 3 * cell.corners.size());
        EXPECT_EQ(2 * static_cast<std::size_t>(cell.faces()), cell.corners.size() + 4) << "Euler's formula";
      }
      for (const auto& [name, corner] : corners)
        EXPECT_EQ(corner.second, std::count_if(name.begin(), name.end(), [n](Index g) { return g < n; }));
    }
}

TEST(Circumcenter, IsEquallyFarFromAll) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    std::vector<Vec3> p;
    for (int k = 0; k < 4; ++k) p.push_back({anywhere(random), anywhere(random), anywhere(random)});
    if (i % 2 == 0) {  // nearly on one circle in one plane
      for (Vec3& X : p) X = 0.7 * normalized({X.x, X.y, 0.0}) + Vec3{0.1, 0.2, 0.3 + 1e-15 * X.z};
      p = {p[0], p[1], p[2], p[3]};
    }
    const Circumcenter center = circumcenter(p, {0, 1, 2, 3});
    const double r = norm(p[0] - center.X);
    for (const Vec3& X : p) EXPECT_NEAR(norm(X - center.X), r, 1e-14 * center.condition * (1.0 + r)) << i;
    if (i % 2 != 0) continue;
    for (const Vec3& X : p)  // on all bisectors all the same
      EXPECT_NEAR(dot(X - p[0], center.X - 0.5 * (X + p[0])), 0.0, 1e-14 * (1.0 + r)) << i;
  }
}

TEST(Fence, KeepsItsDistanceAndHasNoGaps) {
  const TriangleSurface surface = turned(gear_surface(9, 0.4, 1.0, 1.3, 0.5), 0.7);
  const SurfaceIndex index(surface);
  const double distance = 0.3;
  const std::vector<Vec3> fence = fence_points(surface, distance);
  EXPECT_GT(fence.size(), 100U);
  for (const Vec3& X : fence) {
    EXPECT_EQ(index.location(X), Location::outside);
    EXPECT_GE(index.nearest(X).distance, distance);
    EXPECT_LE(index.nearest(X).distance, 3.0 * distance);
  }
  // On every way out there is a point of the fence nearby.
  for (Index t = 0; t < surface.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    const Vec3 start = (1.0 / 3.0) * (a + b + c), way = normalized(start);
    double least = 1e300;
    for (int i = 0; i < 60; ++i)
      for (const Vec3& X : fence) least = std::min(least, norm(start + (0.1 * i * distance) * way - X));
    EXPECT_LE(least, distance);
  }
}

// A small block below a cylinder with particles: flat parts of cells, where their faces lie in the plane of the
// cylinder's bottom, were reported in its stead, as 0 m3 at (inf, nan, inf).
TEST(SurfaceParts, FlatPartsHideNothing) {
  TriangleSurface both = transformed(cylinder_surface(0.3, 1, 0.005), identity(), {0.25, 0.2, 0.2});
  const TriangleSurface block = box_surface({0.2, 0.2, 0}, {0.21, 0.4, 0.01});
  const auto first = static_cast<Index>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), block.vertices.begin(), block.vertices.end());
  for (const auto& [a, b, c] : block.triangles) {
    both.triangles.push_back({first + a, first + b, first + c});
    both.side.push_back(0);
  }
  const SurfaceIndex index(both);
  const PointSet set = place_particles({LatticeSpec{{}, 0.1, 0.0, 1}, {}}, index);
  try {
    surface_cells(set.points, index);
    FAIL() << "the block has no particle";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("1e-05 m3 around (0.205, "), std::string::npos) << error.what();
  }
}

TEST(SurfacePlanes, PutFlatPatchesTogether) {
  const SurfacePlanes planes = find_planes(box_surface({0, 0, 0}, {1, 2, 3}));
  ASSERT_EQ(planes.side.size(), 6U);
  for (std::size_t p = 0; p < 6; ++p) EXPECT_EQ(planes.side[p], static_cast<Index>(p));
  const TriangleSurface ball = ball_surface(1.0, 8, 16);
  EXPECT_EQ(find_planes(ball).side.size(), 16U * 2U + 16U * 6U);  // caps of triangles, rings of flat quadrangles
  TriangleSurface two_sides = box_surface({0, 0, 0}, {1, 1, 1});
  two_sides.side[0] = 1;  // one triangle of "-x" belongs to another side
  EXPECT_EQ(find_planes(two_sides).side.size(), 7U);
}

}  // namespace
}  // namespace tessera::test
