#include <gtest/gtest.h>

#include <cmath>

#include "shapes.hpp"
#include "tessera/geometry/particles.hpp"

namespace tessera {
namespace {

using namespace test;

TEST(Lattice, CellCentresByCounts) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 2, 3}));
  const PointSet set = place_particles(lattice({2, 4, 3}), solid, Placement::cell_centres);
  ASSERT_EQ(set.points.size(), 24U);
  EXPECT_EQ(set.points.front(), (Vec3{0.25, 0.25, 0.5}));
  EXPECT_EQ(set.points.back(), (Vec3{0.75, 1.75, 2.5}));
  ASSERT_TRUE(set.lattice);
  EXPECT_EQ(set.lattice->nodes, (std::array<Index, 3>{2, 4, 3}));
  EXPECT_EQ(set.lattice->spacing, (Vec3{0.5, 0.5, 1}));
  EXPECT_EQ(set.lattice->particle[1], 1);
}

TEST(Lattice, VerticesByCountsReachTheBoundary) {
  const Solid solid = build_solid(box({0.1, 0.2, 0.3}, {0.7, 0.9, 1.3}));
  const PointSet set = place_particles(lattice({4, 4, 4}), solid, Placement::vertices);
  ASSERT_EQ(set.points.size(), 64U);
  EXPECT_EQ(set.points.front(), (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(set.points.back(), (Vec3{0.7, 0.9, 1.3}));  // bitwise, though 0.1 + 3 * 0.2 is not 0.7
}

TEST(Lattice, SpacingIsRoundedToAWholeNumberOfCells) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 0.5, 0.04}));
  EXPECT_EQ(place_particles(lattice(0.19), solid, Placement::cell_centres).points.size(), 5U * 3 * 1);
  EXPECT_EQ(place_particles(lattice(0.19), solid, Placement::vertices).points.size(), 6U * 4 * 2);
}

TEST(Lattice, LeavesOutNodesOutsideTheSolid) {
  const Solid solid = build_solid(l_polygon());
  EXPECT_EQ(place_particles(lattice(1.0), solid, Placement::cell_centres).points.size(), 117U);
  const PointSet set = place_particles(lattice(1.0), solid, Placement::vertices);
  EXPECT_EQ(set.points.size(), 4U * (7 * 4 + 4 * 7));
  EXPECT_EQ(set.lattice->particle[6 + 7 * 10], -1);
}

TEST(Lattice, CellCentresOnTheBoundaryAreNotInside) {
  const Shape triangle = polygon({{0, 0}, {1, 0}, {0, 1}}, 1.0);
  const PointSet set = place_particles(lattice({2, 2, 1}), build_solid(triangle), Placement::cell_centres);
  EXPECT_EQ(set.points.size(), 1U);  // (0.25, 0.25); two others are on the slanted edge
}

TEST(Jitter, StaysWithinItsBoundsAndUsesThem) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const PointSet still = place_particles(lattice(0.1), solid, Placement::cell_centres);
  const PointSet moved = place_particles(lattice(0.1, 0.3, 5), solid, Placement::cell_centres);
  double largest = 0.0, mean = 0.0, square = 0.0;
  for (std::size_t p = 0; p < still.points.size(); ++p)
    for (int d = 0; d < 3; ++d) {
      const double move = (moved.points[p][d] - still.points[p][d]) / (0.3 * 0.1);
      largest = std::max(largest, std::abs(move));
      mean += move / 3000;
      square += move * move / 3000;
    }
  EXPECT_LE(largest, 1.0 + 1e-12);
  EXPECT_GT(largest, 0.99);
  EXPECT_NEAR(mean, 0.0, 0.04);  // 4 standard deviations of the mean of a uniform draw
  EXPECT_NEAR(square, 1.0 / 3.0, 0.025);
}

TEST(Jitter, IsTheSameOnEveryMachine) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const PointSet set = place_particles(lattice({1, 1, 1}, 0.25, 1), solid, Placement::cell_centres);
  EXPECT_EQ(set.points[0].x, 0.43409475782583473);
  EXPECT_EQ(set.points[0].y, 0.7217821154324272);
  EXPECT_EQ(set.points[0].z, 0.27262849886869583);
}

TEST(Jitter, OfANodeDependsOnSeedAndNodeOnly) {
  const PointSet full =
      place_particles(lattice(0.5, 0.2, 3), build_solid(box({0, 0, 0}, {6, 10, 3})), Placement::cell_centres);
  const PointSet part = place_particles(lattice(0.5, 0.2, 3), build_solid(l_polygon()), Placement::cell_centres);
  const PointSet other = place_particles(lattice(0.5, 0.2, 4), build_solid(l_polygon()), Placement::cell_centres);
  ASSERT_EQ(full.lattice->particle.size(), part.lattice->particle.size());
  for (std::size_t node = 0; node < full.lattice->particle.size(); ++node) {
    const Index p = part.lattice->particle[node];
    if (p < 0) continue;
    EXPECT_EQ(part.points[static_cast<std::size_t>(p)],
              full.points[static_cast<std::size_t>(full.lattice->particle[node])]);
    EXPECT_NE(part.points[static_cast<std::size_t>(p)], other.points[static_cast<std::size_t>(p)]);
  }
}

TEST(Jitter, VerticesKeepFacesEdgesAndCorners) {
  const Solid solid = build_solid(l_union());
  const PointSet still = place_particles(lattice(0.5), solid, Placement::vertices);
  const PointSet moved = place_particles(lattice(0.5, 0.49, 2), solid, Placement::vertices);
  ASSERT_EQ(still.points.size(), moved.points.size());
  for (std::size_t p = 0; p < still.points.size(); ++p) {
    const Vec3 &X = still.points[p], &Y = moved.points[p];
    const bool is_fixed_x = X.x == 0 || X.x == 6 || (X.x == 3 && X.y >= 3);
    const bool is_fixed_y = X.y == 0 || X.y == 10 || (X.y == 3 && X.x >= 3);
    EXPECT_EQ(X.x == Y.x, is_fixed_x);
    EXPECT_EQ(X.y == Y.y, is_fixed_y);
    EXPECT_EQ(X.z == Y.z, X.z == 0 || X.z == 3);
  }
}

TEST(Jitter, VerticesStayOnObliquePlanes) {
  const Solid solid = build_solid(polygon({{0, 0}, {1, 0}, {0, 1}}, 1.0));
  const PointSet set = place_particles(lattice({5, 5, 5}, 0.3, 2), solid, Placement::vertices);
  int on_slope = 0, moved = 0;
  for (const Vec3& X : set.points) {
    if (std::abs(X.x + X.y - 1.0) > 1e-15) continue;
    ++on_slope;
    moved += std::abs(4 * X.x - std::round(4 * X.x)) > 1e-3;
  }
  EXPECT_EQ(on_slope, 5 * 5);
  EXPECT_EQ(moved, 3 * 5);
}

TEST(LatticeErrors, SayWhatIsAllowed) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const auto error = [&](const ParticleSpec& spec, Placement placement) {
    return message_of<InputError>([&] { place_particles(spec, solid, placement); });
  };
  expect_contains(error(lattice(-1.0), Placement::cell_centres),
                  "case.toml:7:3: shape: spacing = -1 m must be positive");
  expect_contains(error(lattice(0.1, 0.5), Placement::cell_centres), "jitter = 0.5 is not between 0 and 0.49");
  expect_contains(error(lattice({3, 1, 3}), Placement::vertices), "counts = [3, 1, 3] must be at least 2");
  expect_contains(error(lattice({3, 0, 3}), Placement::cell_centres), "must be at least 1");
  expect_contains(error(lattice(1e-9), Placement::cell_centres), "choose a larger spacing");
  expect_contains(error({MeshFileSpec{"a.msh"}, somewhere()}, Placement::cell_centres), "delaunay");
  expect_contains(error({LatticeSpec{}, somewhere()}, Placement::cell_centres), "either counts or a spacing");
}

TEST(LatticeErrors, EmptyLattice) {
  const Shape diamond = polygon({{0, 0}, {1, 0.9}, {2, 0}, {1, 1}}, 1.0);
  expect_contains(message_of<InputError>([&] {
                    place_particles(lattice({1, 1, 1}), build_solid(diamond), Placement::cell_centres);
                  }),
                  "leaves no particle in the solid");
}

TEST(LatticeErrors, JitterOutOfTheSolidNamesTheParticle) {
  const Solid solid = build_solid(polygon({{0, 0}, {4, 0.3}, {5, 3}, {-1, 3}}, 1.0));
  const std::string message =
      message_of<GeometryError>([&] { place_particles(lattice(0.25, 0.49, 1), solid, Placement::cell_centres); });
  expect_contains(message, "moves particle ");
  expect_contains(message, "out of the solid, to (");
  expect_contains(message, "smaller jitter or another seed");
}

}  // namespace
}  // namespace tessera
