#include <gtest/gtest.h>

#include "voronoi_helpers.hpp"

namespace tessera {
namespace {

using namespace test;

/// Lattices with jitter close to round-off: faces, corners and walls coincide almost, but not quite. What the cells may
/// be off by is of the order of the noise itself, and no more than a few hundred times round-off.
TEST(VoronoiNoise, NearlyRegularLatticesClose) {
  struct Case {
    Shape shape;
    double spacing;
  };
  for (const Case& c : {Case{box({0.1, 0.2, 0.3}, {0.7, 0.8, 0.9}), 0.1}, Case{l_polygon(), 1.0}, Case{l_union(), 1.0},
                        Case{hole(), 0.1}, Case{cavity(), 0.1}}) {
    const Solid solid = build_solid(c.shape);
    for (int exponent = -17; exponent <= -4; ++exponent)
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(::testing::Message() << "jitter 1e" << exponent << " seed " << seed);
        const std::vector<Vec3> points = points_of(lattice(c.spacing, std::pow(10.0, exponent), seed), solid);
        expect_closed(voronoi_cells(points, solid), points, solid, 5e-13);
      }
  }
}

/// Coordinates as a file with few digits has them.
TEST(VoronoiNoise, RoundedCoordinatesClose) {
  const Solid solid = build_solid(union_of({box({0, 0, 0}, {2, 1, 1}), box({0, 0, 0}, {1, 2, 1})}));
  for (const double digits : {1e6, 1e9, 1e12, 1e15}) {
    std::vector<Vec3> points = points_of(lattice(1.0 / 6), solid);
    for (Vec3& X : points)
      for (int d = 0; d < 3; ++d) X[d] = std::round(X[d] * digits) / digits;
    expect_closed(voronoi_cells(points, solid), points, solid, 5e-13);
  }
}

/// Many particles on one sphere share one corner; the corner may fall apart, but the cells must close.
TEST(VoronoiNoise, ParticlesOnASphereClose) {
  const Solid solid = build_solid(box({-1, -1, -1}, {1, 1, 1}));
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) {
    const double z = -0.995 + 0.01 * i, angle = 2.4 * i, r = std::sqrt(1 - z * z);
    points.push_back(0.7 * Vec3{r * std::cos(angle), r * std::sin(angle), z});
  }
  expect_closed(voronoi_cells(points, solid), points, solid, 5e-13);
}

}  // namespace
}  // namespace tessera
