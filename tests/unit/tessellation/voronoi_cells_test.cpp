#include <gtest/gtest.h>

#include <map>

#include "tessera/base/error.hpp"
#include "voronoi_helpers.hpp"

namespace tessera {
namespace {

using namespace test;

TEST(VoronoiCells, OneParticleFillsTheBox) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 2, 3}));
  const Cells cells = voronoi_cells(std::vector<Vec3>{{0.2, 0.3, 0.4}}, solid);
  EXPECT_DOUBLE_EQ(cells.volume[0], 6.0);
  EXPECT_NEAR(norm(cells.centroid[0] - Vec3{0.5, 1, 1.5}), 0, 1e-15);
  EXPECT_TRUE(cells.interior.empty());
  ASSERT_EQ(cells.boundary.size(), 6U);
  for (const BoundaryFace& face : cells.boundary) {
    const Plane& plane = solid.sides[static_cast<std::size_t>(face.side)].plane;
    EXPECT_GT(dot(face.area, plane.normal), 0);
    EXPECT_NEAR(plane.height(face.centroid), 0.0, 1e-15);
  }
}

TEST(VoronoiCells, TwoParticlesShareOneFace) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const Cells cells = voronoi_cells(std::vector<Vec3>{{0.6, 0.5, 0.5}, {0.2, 0.5, 0.5}}, solid);
  ASSERT_EQ(cells.interior.size(), 1U);
  EXPECT_EQ(cells.interior[0].a, 0);
  EXPECT_EQ(cells.interior[0].b, 1);
  EXPECT_NEAR(norm(cells.interior[0].area - Vec3{-1, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(norm(cells.interior[0].centroid - Vec3{0.4, 0.5, 0.5}), 0, 1e-15);
  EXPECT_DOUBLE_EQ(cells.volume[0], 0.6);
  EXPECT_NEAR(norm(cells.centroid[1] - Vec3{0.2, 0.5, 0.5}), 0, 1e-15);
}

class VoronoiSolids : public ::testing::TestWithParam<SolidCase> {};

TEST_P(VoronoiSolids, CellsCloseWhateverTheJitter) {
  const Solid solid = build_solid(GetParam().shape);
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const double jitter : {0.0, 0.2, 0.49}) {
      SCOPED_TRACE(::testing::Message() << "jitter " << jitter << " seed " << seed);
      const std::vector<Vec3> points = points_inside(solid, GetParam().spacing, jitter, seed);
      ASSERT_GT(points.size(), 300U);
      expect_closed(voronoi_cells(points, solid), points, solid);
    }
}

TEST_P(VoronoiSolids, SameInputGivesTheSameBits) {
  const Solid solid = build_solid(GetParam().shape);
  const std::vector<Vec3> points = points_inside(solid, GetParam().spacing, 0.4, 3);
  const Cells a = voronoi_cells(points, solid), b = voronoi_cells(points, solid);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.centroid, b.centroid);
  ASSERT_EQ(a.interior.size(), b.interior.size());
  for (std::size_t f = 0; f < a.interior.size(); ++f) {
    EXPECT_EQ(a.interior[f].area, b.interior[f].area);
    EXPECT_EQ(a.interior[f].centroid, b.interior[f].centroid);
  }
}

TEST_P(VoronoiSolids, FacesAreSortedAndPointOutward) {
  const Solid solid = build_solid(GetParam().shape);
  const std::vector<Vec3> points = points_inside(solid, GetParam().spacing, 0.4, 4);
  const Cells cells = voronoi_cells(points, solid);
  for (std::size_t f = 0; f < cells.interior.size(); ++f) {
    const InteriorFace& face = cells.interior[f];
    ASSERT_LT(face.a, face.b);
    const Vec3 branch = points[static_cast<std::size_t>(face.b)] - points[static_cast<std::size_t>(face.a)];
    EXPECT_GT(dot(face.area, branch), 0);
    if (f == 0) continue;
    const InteriorFace& before = cells.interior[f - 1];
    EXPECT_LT(std::pair(before.a, before.b), std::pair(face.a, face.b));
  }
  for (std::size_t f = 1; f < cells.boundary.size(); ++f) {
    const BoundaryFace &before = cells.boundary[f - 1], &face = cells.boundary[f];
    EXPECT_LT(std::pair(before.owner, before.side), std::pair(face.owner, face.side));
  }
}

TEST_P(VoronoiSolids, SidesGetTheirWholeArea) {
  const Solid solid = build_solid(GetParam().shape);
  const std::vector<Vec3> coarse = points_inside(solid, GetParam().spacing, 0.45, 5);
  const std::vector<Vec3> other = points_inside(solid, 1.3 * GetParam().spacing, 0.1, 6);
  std::map<Index, Vec3> area;
  for (const BoundaryFace& face : voronoi_cells(coarse, solid).boundary) {
    const Plane& plane = solid.sides[static_cast<std::size_t>(face.side)].plane;
    EXPECT_NEAR(norm(face.area), dot(face.area, plane.normal), 1e-13 * norm(face.area));
    EXPECT_NEAR(plane.height(face.centroid), 0, 1e-14 * norm(solid.upper - solid.lower));
    area[face.side] += face.area;
  }
  EXPECT_EQ(area.size(), solid.sides.size());
  for (const BoundaryFace& face : voronoi_cells(other, solid).boundary) area[face.side] -= face.area;
  for (const auto& [side, rest] : area) EXPECT_NEAR(norm(rest), 0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, VoronoiSolids,
                         ::testing::Values(SolidCase{"box", box({0.1, 0.2, 0.3}, {1.1, 1.2, 1.3}), 0.1},
                                           SolidCase{"l_polygon", l_polygon(), 0.6},
                                           SolidCase{"l_union", l_union(), 0.6}, SolidCase{"hole", hole(), 0.1},
                                           SolidCase{"cavity", cavity(), 0.11}, SolidCase{"star", star(), 0.3}),
                         [](const auto& tested) { return tested.param.name; });

TEST(VoronoiLattice, InteriorCellsHaveSixFacesAndNoSlivers) {
  struct Case {
    Shape shape;
    double spacing;
  };
  // In the solids with re-entrant edges, faces of cells coincide with the walls between pieces.
  for (const Case& c : {Case{box({0.1, 0.2, 0.3}, {1.1, 1.2, 1.3}), 0.1}, Case{l_polygon(), 0.5}, Case{l_union(), 0.5},
                        Case{hole(), 0.1}, Case{cavity(), 0.1}}) {
    const Solid solid = build_solid(c.shape);
    const std::vector<Vec3> points = points_of(lattice(c.spacing), solid);
    const Cells cells = voronoi_cells(points, solid);
    expect_closed(cells, points, solid);
    for (const int faces : residuals(cells, points, solid).faces) EXPECT_EQ(faces, 6);
    const double area = c.spacing * c.spacing;
    for (const InteriorFace& face : cells.interior) EXPECT_NEAR(norm(face.area), area, 1e-13 * area);
    for (const BoundaryFace& face : cells.boundary) EXPECT_NEAR(norm(face.area), area, 1e-13 * area);
  }
}

TEST(VoronoiLattice, PolygonAndUnionGiveTheSameCells) {
  const Solid polygon = build_solid(l_polygon()), boxes = build_solid(l_union());
  for (const double jitter : {0.0, 0.3}) {
    const std::vector<Vec3> points = points_of(lattice(0.7, jitter, 2), polygon);
    const Cells a = voronoi_cells(points, polygon), b = voronoi_cells(points, boxes);
    ASSERT_EQ(a.interior.size(), b.interior.size());
    ASSERT_EQ(a.boundary.size(), b.boundary.size());
    for (std::size_t f = 0; f < a.interior.size(); ++f) {
      EXPECT_EQ(a.interior[f].b, b.interior[f].b);
      EXPECT_NEAR(norm(a.interior[f].area - b.interior[f].area), 0, 1e-13);
      EXPECT_NEAR(norm(a.interior[f].centroid - b.interior[f].centroid), 0, 1e-9);
    }
    for (std::size_t p = 0; p < points.size(); ++p) {
      EXPECT_NEAR(a.volume[p], b.volume[p], 1e-14);
      EXPECT_NEAR(norm(a.centroid[p] - b.centroid[p]), 0, 1e-13);
    }
  }
}

/// A slot thinner than the cells: they reach through it into the other arm, and own what is nearest to them there.
TEST(VoronoiCells, ReachAcrossASlot) {
  const Solid solid = build_solid(difference_of({box({0, 0, 0}, {1, 1, 1}), box({0.45, 0.3, 0}, {0.5, 1, 1})}));
  std::vector<Vec3> points = points_inside(solid, 0.17, 0.49, 7);
  std::erase_if(points, [](const Vec3& X) { return X.x > 0.5 && X.x < 0.7 && X.y > 0.3; });
  const Cells cells = voronoi_cells(points, solid);
  expect_closed(cells, points, solid);
  bool has_crossed = false;
  for (const Polyhedron& part : voronoi_polyhedra(points, solid)) {
    if (points[static_cast<std::size_t>(part.particle)].x > 0.45) continue;
    for (const Vec3& X : part.vertices) has_crossed = has_crossed || (X.x > 0.5 + 1e-9 && X.y > 0.4);
  }
  EXPECT_TRUE(has_crossed);
}

TEST(VoronoiCells, SizeAndPlaceDoNotMatter) {
  for (const double size : {1e-9, 1e-3, 1e6}) {
    const Vec3 corner{size, -2 * size, 0};
    const Solid solid = build_solid(box(corner, corner + Vec3{size, size, size}));
    const std::vector<Vec3> points = points_of(lattice(0.1 * size, 0.3), solid);
    expect_closed(voronoi_cells(points, solid), points, solid);
  }
}

std::string error_of(const std::vector<Vec3>& points) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  return message_of<GeometryError>([&] { voronoi_cells(points, solid); });
}

TEST(VoronoiErrors, NameTheParticles) {
  expect_contains(error_of({}), "no particles");
  expect_contains(error_of({{0.5, 0.5, 0.5}, {2, 0.5, 0.5}}), "particle 1 at (2, 0.5, 0.5) m lies outside the solid");
  expect_contains(error_of({{0.2, 0.5, 0.5}, {0.2, 0.5, 0.5}}), "particles 0 at (0.2, 0.5, 0.5) m and 1 at");
}

}  // namespace
}  // namespace tessera
