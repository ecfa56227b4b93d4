#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shapes.hpp"
#include "support/surfaces.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/solid_surface.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera::test {
namespace {

ParticleSpec crystal(LatticeKind kind, std::array<int, 3> counts, double jitter = 0.0) {
  return {LatticeSpec{counts, {}, jitter, 1, kind, {}}, somewhere()};
}
ParticleSpec near_count(LatticeKind kind, Index count) {
  return {LatticeSpec{{}, {}, 0.0, 1, kind, count}, somewhere()};
}
ParticleSpec random_of(Index count, std::uint64_t seed = 1) { return {RandomSpec{{count, {}}, seed}, somewhere()}; }
ParticleSpec relaxed_of(Index count, const std::string& size = "") {
  RelaxedSpec spec;
  spec.amount.count = count;
  if (!size.empty()) spec.size = Formula(size, somewhere());
  return {spec, somewhere()};
}

std::vector<Vec3> in_box(const ParticleSpec& spec, const Vec3& size = {1, 1, 1}) {
  return place_particles(spec, build_solid(box({0, 0, 0}, size)), Placement::cell_centres).points;
}

double nearest_distance(const std::vector<Vec3>& points, std::size_t a) {
  double nearest = 1e300;
  for (std::size_t b = 0; b < points.size(); ++b)
    if (b != a) nearest = std::min(nearest, norm(points[b] - points[a]));
  return nearest;
}

double least_distance(const std::vector<Vec3>& points) {
  double least = 1e300;
  for (std::size_t a = 0; a < points.size(); ++a) least = std::min(least, nearest_distance(points, a));
  return least;
}

/// Points as near as any to the one nearest to the middle.
int neighbours_in_the_middle(const std::vector<Vec3>& points, const Vec3& middle) {
  const auto a = static_cast<std::size_t>(
      std::min_element(points.begin(), points.end(),
                       [&](const Vec3& X, const Vec3& Y) { return norm(X - middle) < norm(Y - middle); }) -
      points.begin());
  const double nearest = nearest_distance(points, a);
  return static_cast<int>(std::count_if(points.begin(), points.end(), [&](const Vec3& X) {
    return norm(X - points[a]) > 0 && norm(X - points[a]) < (1 + 1e-9) * nearest;
  }));
}

/// Sites per unit cell, distance of neighbours and their number as in every textbook. Boxes whose sides are as the
/// cell's leave the lattice undistorted.
TEST(Arrangement, CrystalsAreWhatTheyAreCalled) {
  const std::vector<Vec3> bcc = in_box(crystal(LatticeKind::bcc, {4, 4, 4}));
  EXPECT_EQ(bcc.size(), 2U * 64);
  EXPECT_NEAR(least_distance(bcc), std::sqrt(0.75) / 4, 1e-15);
  EXPECT_EQ(neighbours_in_the_middle(bcc, {0.5, 0.5, 0.5}), 8);
  const std::vector<Vec3> fcc = in_box(crystal(LatticeKind::fcc, {4, 4, 4}));
  EXPECT_EQ(fcc.size(), 4U * 64);
  EXPECT_NEAR(least_distance(fcc), std::sqrt(0.5) / 4, 1e-15);
  EXPECT_EQ(neighbours_in_the_middle(fcc, {0.5, 0.5, 0.5}), 12);
  const Vec3 size{4, 4 * std::sqrt(3.0), 4 * std::sqrt(8.0 / 3)};
  const std::vector<Vec3> hcp = in_box(crystal(LatticeKind::hcp, {4, 4, 4}), size);
  EXPECT_EQ(hcp.size(), 4U * 64);
  EXPECT_NEAR(least_distance(hcp), 1.0, 1e-14);
  EXPECT_EQ(neighbours_in_the_middle(hcp, 0.5 * size), 12);
}

/// Turned about the middle of the box, every lattice is the same again, so no side is preferred.
TEST(Arrangement, CrystalsLookAlikeFromOppositeSides) {
  for (const LatticeKind kind : {LatticeKind::bcc, LatticeKind::fcc, LatticeKind::hcp}) {
    Vec3 sum;
    const std::vector<Vec3> points = in_box(crystal(kind, {3, 4, 5}));
    for (const Vec3& X : points) sum += X - Vec3{0.5, 0.5, 0.5};
    EXPECT_LT(norm(sum), 1e-12);
  }
}

TEST(Arrangement, CrystalsKeepTheirDistanceFromTheSurface) {
  const TriangleSurface ball = ball_surface(1.0, 20, 40);
  const SurfaceIndex index(ball);
  for (const LatticeKind kind : {LatticeKind::bcc, LatticeKind::fcc, LatticeKind::hcp})
    for (const double jitter : {0.0, 0.3}) {
      const std::vector<Vec3> points = place_particles(crystal(kind, {6, 6, 6}, jitter), index).points;
      const double spacing = 2.0 / 6 / std::cbrt(kind == LatticeKind::bcc ? 2.0 : 4.0);
      double nearest = 1.0;
      for (const Vec3& X : points) nearest = std::min(nearest, index.nearest(X).distance);
      EXPECT_GE(nearest, 0.99 * kLeastDepth * spacing);
      EXPECT_GT(points.size(), 100U);
    }
}

TEST(Arrangement, LatticesComeNearTheNumberAskedFor) {
  const TriangleSurface ball = ball_surface(1.0, 20, 40);
  const SurfaceIndex index(ball);
  for (const LatticeKind kind : {LatticeKind::cubic, LatticeKind::bcc, LatticeKind::fcc, LatticeKind::hcp}) {
    EXPECT_NEAR(static_cast<double>(in_box(near_count(kind, 2000)).size()), 2000, 300);
    EXPECT_NEAR(static_cast<double>(place_particles(near_count(kind, 2000), index).points.size()), 2000, 200);
  }
  const Solid cube = build_solid(box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(place_particles(near_count(LatticeKind::cubic, 1000), cube, Placement::vertices).points.size(), 1000U);
}

TEST(Arrangement, RandomParticlesKeepTheirDistances) {
  const Solid block = build_solid(l_polygon());
  const std::vector<Vec3> points = place_particles(random_of(800), block, Placement::cell_centres).points;
  ASSERT_EQ(points.size(), 800U);
  const double spacing = std::cbrt(block.volume / 800);
  EXPECT_GT(least_distance(points), 0.78 * spacing);
  const TriangleSurface surface = surface_of(block);
  const SurfaceIndex index(surface);
  for (const Vec3& X : points) EXPECT_FALSE(index.is_nearer_than(kLeastDepth * spacing, X));
  RandomSpec by_spacing;
  by_spacing.amount.spacing = 0.2;
  EXPECT_EQ(in_box({by_spacing, somewhere()}).size(), 125U);
}

/// More than one block of particles, so that threads have something to share; and the same on every machine.
TEST(Arrangement, DependsOnTheSeedAlone) {
  const int before = parallel::threads();
  const auto points = [](int threads, const ParticleSpec& spec) {
    parallel::set_threads(threads);
    return in_box(spec);
  };
  for (const ParticleSpec& spec :
       {random_of(3000), relaxed_of(3000, "1 + X"), crystal(LatticeKind::hcp, {9, 9, 9}, 0.2)})
    EXPECT_EQ(points(1, spec), points(3, spec));
  parallel::set_threads(before);
  EXPECT_NE(in_box(random_of(100, 1)), in_box(random_of(100, 2)));
  const Vec3 first = in_box(random_of(10)).front();
  EXPECT_EQ(first, (Vec3{0x1.169ad167f9f9bp-1, 0x1.d4adb4b3024e9p-4, 0x1.55c1edab6bbddp-1}));
}

/// With a size of 1 + X the density goes as (1 + X)^-3.
TEST(Arrangement, RelaxedParticlesStartWithTheDensityThatTheSizeAsksFor) {
  const std::vector<Vec3> points = in_box(relaxed_of(2000, "1 + X"));
  ASSERT_EQ(points.size(), 2000U);
  const auto share =
      static_cast<double>(std::count_if(points.begin(), points.end(), [](const Vec3& X) { return X.x < 0.5; })) / 2000;
  const double exact = (1 - 1 / (1.5 * 1.5)) / (1 - 1 / 4.0);  // integrals of (1 + X)^-3
  EXPECT_NEAR(share, exact, 0.02);
}

/// In a plane the third direction takes no part.
TEST(Arrangement, LiesInAPlane) {
  const Solid slab = build_solid(box({0, 0, 0}, {200, 100, 1}));
  for (ParticleSpec spec : {random_of(200), relaxed_of(200)}) {
    spec.dimension = 2;
    const std::vector<Vec3> points = place_particles(spec, slab, Placement::cell_centres).points;
    ASSERT_EQ(points.size(), 200U);
    for (const Vec3& X : points) EXPECT_EQ(X.z, 0.5);
    if (std::holds_alternative<RandomSpec>(spec.source)) {
      EXPECT_GT(least_distance(points), 7.0);  // of the spacing 10
    }
  }
}

TEST(Arrangement, RefusesWhatHasNoRoomOrMakesNoSense) {
  const Solid cube = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const auto message = [&](const ParticleSpec& spec, const Solid& solid,
                           Placement placement = Placement::cell_centres) {
    return message_of<InputError>([&] { place_particles(spec, solid, placement); });
  };
  for (const ParticleSpec& spec : {random_of(10), relaxed_of(10), crystal(LatticeKind::bcc, {2, 2, 2})})
    expect_contains(message(spec, cube, Placement::vertices),
                    "centres of Voronoi cells, none of which lies on the boundary");
  expect_contains(message(relaxed_of(10, "X - 0.5"), cube), "it must be positive everywhere");
  const Solid sheet = build_solid(box({0, 0, 0}, {1, 1, 1e-4}));
  expect_contains(message(relaxed_of(10), sheet), "no room for 10 particles");
  expect_contains(message(random_of(10), sheet), "no room for 10 particles");
  expect_contains(message(crystal(LatticeKind::hcp, {3, 3, 1}), sheet), "choose a finer one");
  RandomSpec dust;
  dust.amount.spacing = 1e-6;
  expect_contains(message({dust, somewhere()}, cube), "choose a larger spacing");
}

}  // namespace
}  // namespace tessera::test
