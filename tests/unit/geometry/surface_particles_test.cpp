#include <gtest/gtest.h>

#include "shapes.hpp"
#include "support/surfaces.hpp"
#include "tessera/geometry/particles.hpp"

namespace tessera::test {
namespace {

ParticleSpec lattice_of(double spacing, double jitter, std::uint64_t seed) {
  LatticeSpec lattice;
  lattice.spacing = spacing;
  lattice.jitter = jitter;
  lattice.seed = seed;
  return {lattice, somewhere()};
}

TEST(SurfaceParticles, KeepTheirDistanceFromTheSurface) {
  const TriangleSurface ball = ball_surface(1.0, 20, 40);
  const SurfaceIndex index(ball);
  for (const double jitter : {0.0, 0.2, 0.49}) {
    const std::vector<Vec3> points = place_particles(lattice_of(0.2, jitter, 1), index).points;
    EXPECT_GT(points.size(), 400U);
    double nearest = 1.0;
    for (const Vec3& X : points) {
      EXPECT_EQ(index.location(X), Location::inside);
      nearest = std::min(nearest, index.nearest(X).distance);
    }
    EXPECT_GE(nearest, kLeastDepth * 0.199);
    EXPECT_LT(nearest, 0.1);
  }
}

/// In a box the lattice is that of the box.
TEST(SurfaceParticles, AreThoseOfTheSolidWhereItIsABox) {
  const TriangleSurface surface = box_surface({0, 0, 0}, {1, 2, 3});
  const SurfaceIndex index(surface);
  for (const double jitter : {0.0, 0.25}) {
    const ParticleSpec spec = lattice_of(0.25, jitter, 7);
    EXPECT_EQ(place_particles(spec, index).points,
              place_particles(spec, build_solid(box({0, 0, 0}, {1, 2, 3})), Placement::cell_centres).points);
  }
}

TEST(SurfaceParticles, RefuseALatticeThatLeavesNone) {
  const TriangleSurface ball = ball_surface(1.0, 10, 20);
  const SurfaceIndex index(ball);
  ParticleSpec spec;
  LatticeSpec lattice;
  lattice.counts = {2, 2, 2};
  spec.source = lattice;
  EXPECT_THROW(place_particles(spec, index), InputError);  // centres 0.13 m below the surface, 1 m apart
  lattice.counts = {3, 3, 3};
  spec.source = lattice;
  EXPECT_GT(place_particles(spec, index).points.size(), 6U);
}

}  // namespace
}  // namespace tessera::test
