#include "tessera/geometry/surface_primitives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "shapes.hpp"
#include "support/surfaces.hpp"
#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_sides.hpp"
#include "tessera/geometry/surface_transform.hpp"

namespace tessera {
namespace {

constexpr double pi = std::numbers::pi;

/// Distance of X from the true surface.
using Distance = std::function<double(const Vec3& X)>;

double distance_from_circle_around_z(const Vec3& X, double radius, double z) {
  return std::hypot(std::hypot(X.x, X.y) - radius, X.z - z);
}

struct Primitive {
  TriangleSurface (*make)(double tolerance);
  std::vector<std::string> sides;
  double volume;
  Distance distance;  // from the curved side; no more than from the whole surface for points of a lid
};

std::vector<Primitive> primitives() {
  return {
      {[](double t) { return cylinder_surface(0.5, 2, t); },
       {"bottom", "top", "mantle"},
       0.5 * pi,
       [](const Vec3& X) { return X.z == 0 || X.z == 2 ? 0.0 : std::abs(std::hypot(X.x, X.y) - 0.5); }},
      {[](double t) { return cone_surface(1, 0.25, 2, t); },
       {"bottom", "top", "mantle"},
       2 * pi / 3 * (1 + 0.25 + 0.0625),
       [](const Vec3& X) {
         return X.z == 0 || X.z == 2 ? 0.0 : std::abs(std::hypot(X.x, X.y) - (1 - 0.375 * X.z)) / std::hypot(1, 0.375);
       }},
      {[](double t) { return cone_surface(1, 0, 2, t); },
       {"bottom", "mantle"},
       2 * pi / 3,
       [](const Vec3& X) {
         return X.z == 0 ? 0.0 : std::abs(std::hypot(X.x, X.y) - (1 - 0.5 * X.z)) / std::hypot(1, 0.5);
       }},
      {[](double t) { return cone_surface(0, 1, 2, t); },
       {"top", "mantle"},
       2 * pi / 3,
       [](const Vec3& X) { return X.z == 2 ? 0.0 : std::abs(std::hypot(X.x, X.y) - 0.5 * X.z) / std::hypot(1, 0.5); }},
      {[](double t) { return sphere_surface(2, t); },
       {"mantle"},
       32 * pi / 3,
       [](const Vec3& X) { return std::abs(norm(X) - 2); }},
      {[](double t) { return torus_surface(2, 0.5, t); },
       {"mantle"},
       pi * pi,
       [](const Vec3& X) { return std::abs(distance_from_circle_around_z(X, 2, 0) - 0.5); }},
      // Along the ray from the centre, which is no shorter than the distance.
      {[](double t) {
         return ellipsoid_surface({2, 1, 0.5}, t);
       },
       {"mantle"},
       4 * pi / 3,
       [](const Vec3& X) {
         return norm(X) * std::abs(1 - 1 / norm({X.x / 2, X.y, X.z / 0.5}));
       }}};
}

TEST(SurfacePrimitives, AreSoundAndStayWithinTheTolerance) {
  for (const Primitive& primitive : primitives())
    for (const double tolerance : {0.2, 0.02, 0.002}) {
      const TriangleSurface surface = primitive.make(tolerance);
      const CheckedSurface checked = check_surface({"primitive", PlaceUnit::line, surface, {}});
      EXPECT_FALSE(checked.repairs.any());
      EXPECT_EQ(checked.shells, 1);
      EXPECT_EQ(checked.surface.side_names, primitive.sides);
      double farthest = 0.0;
      for (Index t = 0; t < surface.size(); ++t) {
        const auto [a, b, c] = surface.corners(t);
        for (int i = 0; i <= 6; ++i)
          for (int j = 0; i + j <= 6; ++j)
            farthest = std::max(farthest, primitive.distance(a + (i / 6.0) * (b - a) + (j / 6.0) * (c - a)));
      }
      EXPECT_LE(farthest, tolerance);
      EXPECT_GT(farthest, tolerance / 5) << "needlessly fine";
      EXPECT_LE(std::abs(volume(surface) - primitive.volume), tolerance * area(surface));
    }
}

TEST(SurfacePrimitives, RefuseWhatHasNoVolume) {
  const auto fault = [](auto make) { return test::message_of<GeometryError>(make); };
  test::expect_contains(fault([] { cylinder_surface(0, 1, 0.1); }), "radius must be a positive length, not 0 m");
  test::expect_contains(fault([] { cylinder_surface(1, -1, 0.1); }), "height must be");
  test::expect_contains(fault([] { cone_surface(0, 0, 1, 0.1); }), "top radius must be");
  test::expect_contains(fault([] { cone_surface(1, -1, 1, 0.1); }), "top radius must be");
  test::expect_contains(fault([] { sphere_surface(1, 0); }), "tolerance must be");
  test::expect_contains(fault([] { sphere_surface(1, 1e-9); }), "allow a larger one");
  test::expect_contains(fault([] { torus_surface(1, 1, 0.1); }), "must be smaller than the radius");
  test::expect_contains(fault([] { ellipsoid_surface({1, 2, NAN}, 0.1); }), "semi-axis must be");
}

TEST(SurfaceTransform, KeepsVolumesAndTheOutside) {
  const TriangleSurface cone = cone_surface(1, 0.5, 2, 0.01);
  EXPECT_NEAR(volume(transformed(cone, rotation({1, -2, 0.5}, 77), {10, 20, 30})), volume(cone), 1e-11);
  EXPECT_NEAR(volume(transformed(cone, diagonal(2, 3, 4), {})), 24 * volume(cone), 1e-11);
  EXPECT_NEAR(volume(transformed(cone, diagonal(-1, 1, 1), {})), volume(cone), 1e-13);  // a mirror image
}

TEST(SurfaceTransform, RotationsTurnCounterClockwiseAndQuarterTurnsAreExact) {
  EXPECT_EQ(rotation({0, 0, 2}, 90) * (Vec3{1, 0, 0.25}), (Vec3{0, 1, 0.25}));
  EXPECT_EQ(rotation({1, 0, 0}, 270) * (Vec3{0, 1, 0}), (Vec3{0, 0, -1}));
  EXPECT_EQ(rotation({0, 1, 0}, -180) * (Vec3{1, 3, 2}), (Vec3{-1, 3, -2}));
  const Vec3 turned = rotation({1, 1, 1}, 120) * Vec3{1, 0, 0};
  EXPECT_LT(norm(turned - Vec3{0, 1, 0}), 1e-15);
}

}  // namespace
}  // namespace tessera
