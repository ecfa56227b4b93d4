#include "tessera/geometry/triangle_surface.hpp"

#include <gtest/gtest.h>

namespace tessera {
namespace {

/// The corner of a cube of edge 2 at (1, 1, 1), cut off.
TriangleSurface tetrahedron() {
  return {{{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1, 1, 3}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
          {0, 0, 0, 1},
          {"legs", "cut"}};
}

TEST(TriangleSurface, MeasuresOfATetrahedron) {
  const TriangleSurface surface = tetrahedron();
  EXPECT_NEAR(volume(surface), 8.0 / 6.0, 1e-15);
  EXPECT_NEAR(area(surface), 3 * 2.0 + 0.5 * 8.0 * std::sqrt(3.0) / 2.0, 1e-14);
  EXPECT_EQ(area_vector(surface, 3), (Vec3{2, 2, 2}));
  const Bounds box = bounds(surface);
  EXPECT_EQ(box.lower, (Vec3{1, 1, 1}));
  EXPECT_EQ(box.upper, (Vec3{3, 3, 3}));
}

TEST(TriangleSurface, VolumeOfAnInsideOutSurfaceIsNegative) {
  TriangleSurface surface = tetrahedron();
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(volume(surface), -8.0 / 6.0, 1e-15);
}

}  // namespace
}  // namespace tessera
