#include <gtest/gtest.h>

#include <algorithm>

#include "tessera/tessellation/clip.hpp"
#include "tessera/tessellation/voronoi_nearest.hpp"

namespace tessera {
namespace {

ConvexPolyhedron unit_cube() {
  ConvexPolyhedron cube;
  for (int v = 0; v < 8; ++v) cube.vertices.push_back({v & 1 ? 1.0 : 0.0, v & 2 ? 1.0 : 0.0, v & 4 ? 1.0 : 0.0});
  const std::vector<std::vector<Index>> faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Index tag = 10;
  for (const auto& face : faces) {
    cube.corners.insert(cube.corners.end(), face.begin(), face.end());
    cube.close_face(tag++);
  }
  return cube;
}

double volume(const ConvexPolyhedron& p) {
  double sum = 0.0;
  for (Index f = 0; f < p.faces(); ++f) {
    const auto at = [&](std::size_t i) { return p.vertices[static_cast<std::size_t>(p.face(f)[i])]; };
    for (std::size_t i = 1; i + 1 < p.face(f).size(); ++i) sum += dot(at(0), cross(at(i), at(i + 1))) / 6.0;
  }
  return sum;
}

TEST(Clipper, CutsOffACorner) {
  Clipper clipper(1e-12);
  ConvexPolyhedron cube = unit_cube();
  const Vec3 n = normalized({1, 1, 1});
  EXPECT_EQ(clipper.clip(cube, {n, 2.5 / std::sqrt(3.0)}, 99), Clipper::Outcome::cut);
  EXPECT_EQ(cube.faces(), 7);
  EXPECT_EQ(cube.vertices.size(), 10U);
  EXPECT_EQ(cube.face(6).size(), 3U);
  EXPECT_EQ(cube.tags[6], 99);
  EXPECT_NEAR(volume(cube), 1 - 0.125 / 6, 1e-15);
}

TEST(Clipper, PlanesThroughVerticesAndFacesMakeNoSlivers) {
  Clipper clipper(1e-12);
  ConvexPolyhedron cube = unit_cube();
  EXPECT_EQ(clipper.clip(cube, {{1, 0, 0}, 1 + 5e-13}, 99), Clipper::Outcome::untouched);
  EXPECT_EQ(clipper.clip(cube, {{1, 0, 0}, 1 - 5e-13}, 99), Clipper::Outcome::untouched);
  EXPECT_TRUE(clipper.lies_in(cube, 1, {{1, 0, 0}, 1 - 5e-13}));
  EXPECT_FALSE(clipper.lies_in(cube, 0, {{1, 0, 0}, 1 - 5e-13}));
  const double h = std::sqrt(0.5);
  EXPECT_EQ(clipper.clip(cube, {{h, h, 0}, h + 3e-13}, 99), Clipper::Outcome::cut);
  EXPECT_EQ(cube.faces(), 5);  // a wedge, its two vertical edges on the plane untouched
  EXPECT_EQ(cube.vertices.size(), 6U);
  EXPECT_EQ(volume(cube), 0.5);
  EXPECT_EQ(clipper.clip(cube, {{-1, 0, 0}, -1 + 5e-13}, 99), Clipper::Outcome::emptied);
  EXPECT_TRUE(cube.is_empty());
}

TEST(Clipper, SplitPartsMakeTheWhole) {
  Clipper clipper(1e-12);
  const double h = std::sqrt(0.5);
  for (const Plane& plane : {Plane{{1, 0, 0}, 0.25}, Plane{{1, 0, 0}, 1.0}, Plane{{1, 0, 0}, 0.0}, Plane{{h, h, 0}, h},
                             Plane{normalized({1, 1e-14, 1e-15}), 1.0}, Plane{{0, 1, 0}, 1 - 1e-15}}) {
    ConvexPolyhedron below = unit_cube(), above = unit_cube();
    clipper.split(below, plane, 98);
    clipper.split(above, {-plane.normal, -plane.offset}, 99);
    EXPECT_NEAR(volume(below) + volume(above), 1.0, 1e-15);
  }
}

TEST(NearestPoints, ListsAllInOrder) {
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i)
    points.push_back({std::fmod(0.137 * i, 1.0), std::fmod(0.611 * i, 1.0), std::fmod(0.377 * i * i, 1.0)});
  const PointGrid grid(points, {0, 0, 0}, {1, 1, 1}, 0.126);
  NearestPoints nearest(grid);
  for (const Index center : {0, 123, 499}) {
    std::vector<std::pair<double, Index>> expected;
    for (Index p = 0; p < 500; ++p)
      if (p != center)
        expected.emplace_back(norm(points[static_cast<std::size_t>(p)] - points[static_cast<std::size_t>(center)]), p);
    std::sort(expected.begin(), expected.end());
    nearest.start(center, points[static_cast<std::size_t>(center)]);
    for (std::size_t rank = 0; rank < expected.size(); ++rank)
      ASSERT_EQ(nearest.neighbour(rank, 2.0), expected[rank].second) << rank;
    EXPECT_EQ(nearest.neighbour(499, 1e9), -1);
    nearest.start(center, points[static_cast<std::size_t>(center)]);
    EXPECT_EQ(nearest.neighbour(0, 0.9 * expected[0].first), -1);
    EXPECT_EQ(nearest.neighbour(0, expected[0].first), expected[0].second);
  }
}

}  // namespace
}  // namespace tessera
