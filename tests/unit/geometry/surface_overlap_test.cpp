#include "tessera/geometry/surface_overlap.hpp"

#include <gtest/gtest.h>

#include "support/surfaces.hpp"
#include "support/triangle_surfaces.hpp"

namespace tessera {
namespace {

using test::ball_surface;
using test::box_surface;
using test::turned;

std::optional<Vec3> overlap(const TriangleSurface& a, const TriangleSurface& b, const std::vector<Vec3>& in_a = {}) {
  const SurfaceIndex index_a(a), index_b(b);
  const auto one = find_overlap({index_a, in_a}, {index_b, {}}, 1e-9),
             other = find_overlap({index_b, {}}, {index_a, in_a}, 1e-9);
  EXPECT_EQ(one.has_value(), other.has_value());
  return one;
}

TEST(SurfaceOverlap, BoxesAroundBodiesSayNothing) {
  // A pin in the hole of a ring, and a ball beside the corner of a turned box.
  const TriangleSurface ring = test::gear_surface(9, 0.4, 1.0, 1.3, 0.5);
  EXPECT_FALSE(overlap(ring, box_surface({-0.2, -0.2, -1}, {0.2, 0.2, 2})));
  EXPECT_TRUE(overlap(ring, box_surface({-0.41, -0.2, -1}, {0.2, 0.2, 2})));
  EXPECT_FALSE(
      overlap(turned(box_surface({-1, -1, -1}, {1, 1, 1}), 0.7), turned(box_surface({1.01, -1, -1}, {2, 1, 1}), 0.7)));
}

TEST(SurfaceOverlap, TouchingIsNone) {
  EXPECT_FALSE(overlap(box_surface({0, 0, 0}, {1, 1, 1}), box_surface({1, 0, 0}, {2, 1, 1})));
  EXPECT_FALSE(
      overlap(turned(box_surface({0, 0, 0}, {1, 1, 1}), 0.7), turned(box_surface({1, 0.5, 0}, {2, 1, 1}), 0.7)));
  EXPECT_TRUE(overlap(box_surface({0, 0, 0}, {1, 1, 1}), box_surface({1 - 1e-6, 0, 0}, {2, 1, 1})));
}

TEST(SurfaceOverlap, OneInsideTheOther) {
  EXPECT_TRUE(overlap(ball_surface(1.0, 12, 24), box_surface({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})));
  // Two of the same kind have no corner inside each other, but points.
  const TriangleSurface cube = box_surface({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(overlap(cube, cube, {{0.5, 0.5, 0.5}}));
}

TEST(SurfaceOverlap, ThePlaceIsInBoth) {
  const TriangleSurface bar = box_surface({-3, -0.1, -0.1}, {3, 0.1, 0.1});
  const auto X = overlap(bar, turned(box_surface({-1, -1, -1}, {1, 1, 1}), 0.3));
  ASSERT_TRUE(X);
  EXPECT_LT(norm(*X), 2.0);
  EXPECT_LE(std::abs(X->y), 0.1 + 1e-12);
}

}  // namespace
}  // namespace tessera
