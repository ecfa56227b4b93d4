#include "tessera/geometry/solid_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shapes.hpp"
#include "support/surfaces.hpp"
#include "tessera/geometry/surface_index.hpp"
#include "tessera/geometry/surface_sides.hpp"

namespace tessera {
namespace {

using namespace test;

std::vector<Shape> shapes() {
  return {box({0, 0, 0}, {1, 2, 3}),
          l_polygon(),
          l_union(),
          union_of({box({0, 0, 0}, {3, 1, 1}), box({1, 1, 0}, {2, 2, 0.5}, "knob"), box({0, 0, 1}, {1, 0.25, 2})}),
          difference_of({box({0, 0, 0}, {4, 4, 1}), box({1, 1, 0}, {2, 3, 1}, "window"), box({3, 0, 0.5}, {4, 1, 1})}),
          difference_of({box({0, 0, 0}, {3, 3, 3}), box({1, 1, 1}, {2, 2, 2}, "bubble")}),
          union_of({box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1})}),
          polygon({{0, 0}, {4, 1}, {5, 5}, {2.5, 1.7}, {0.3, 4}}, 0.7, -0.2)};
}

TEST(SurfaceOfASolid, HasItsVolumeItsSidesAndItsInside) {
  for (const Shape& shape : shapes()) {
    const Solid solid = build_solid(shape);
    const TriangleSurface surface = surface_of(solid);
    EXPECT_TRUE(is_closed(surface));
    EXPECT_NEAR(volume(surface), solid.volume, 1e-13 * solid.volume);
    EXPECT_LT(norm(bounds(surface).lower - solid.lower), 1e-14);  // slanted edges meet to round-off
    EXPECT_LT(norm(bounds(surface).upper - solid.upper), 1e-14);
    for (const SideSummary& side : summarize_sides(surface)) {
      const bool is_known =
          std::any_of(solid.sides.begin(), solid.sides.end(), [&](const Side& s) { return s.names[0] == side.name; });
      EXPECT_TRUE(is_known) << side.name;
    }
    const SurfaceIndex index(surface);
    const Vec3 size = solid.upper - solid.lower;
    for (int i = 0; i < 2000; ++i) {
      const auto part = [i](double step) { return 1.2 * std::fmod(step * i, 1.0) - 0.1; };
      const Vec3 X =
          solid.lower + Vec3{part(0.7548776662) * size.x, part(0.5698402910) * size.y, part(0.4301597090) * size.z};
      EXPECT_EQ(index.contains(X), solid.contains(X, 0.0));
    }
  }
}

TEST(SurfaceOfASolid, AxisParallelSidesLieExactlyInTheirPlanes) {
  const TriangleSurface surface = surface_of(build_solid(
      difference_of({box({0.1, 0.2, 0.3}, {1.7, 1.9, 2.3}), box({0.1, 0.7, 0.9}, {1.1, 1.3, 2.3}, "slot")})));
  for (const Vec3& X : surface.vertices) {
    EXPECT_TRUE(X.x == 0.1 || X.x == 1.1 || X.x == 1.7) << X.x;
    EXPECT_TRUE(X.y == 0.2 || X.y == 0.7 || X.y == 1.3 || X.y == 1.9) << X.y;
    EXPECT_TRUE(X.z == 0.3 || X.z == 0.9 || X.z == 2.3) << X.z;
  }
}

}  // namespace
}  // namespace tessera
