#include "tessera/geometry/surface_index.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/surfaces.hpp"

namespace tessera {
namespace {

using test::ball_surface;
using test::box_surface;
using test::spiky_surface;
using test::torus_surface;

/// The solid angle at X over 4 pi (A. Van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30, 1983): the winding
/// number, to round-off, by a way that shares nothing with rays.
double solid_angle_winding(const TriangleSurface& surface, const Vec3& X) {
  double sum = 0.0;
  for (Index t = 0; t < surface.size(); ++t) {
    const auto corners = surface.corners(t);
    const Vec3 a = corners[0] - X, b = corners[1] - X, c = corners[2] - X;
    const double u = norm(a), v = norm(b), w = norm(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), u * v * w + dot(a, b) * w + dot(b, c) * u + dot(c, a) * v);
  }
  return sum / (4 * std::numbers::pi);
}

std::vector<TriangleSurface> solids() {
  TriangleSurface inside_out = ball_surface(0.7, 6, 9);
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  return {box_surface({-0.5, -0.5, -0.5}, {0.5, 0.25, 0.75}), ball_surface(0.9, 8, 12), torus_surface(0.6, 0.3, 12, 8),
          spiky_surface(3, 14, 20, 0.1), inside_out};
}

TEST(TestSurfaces, AreClosed) {
  for (const TriangleSurface& surface : solids()) EXPECT_TRUE(test::is_closed(surface));
  EXPECT_NEAR(volume(ball_surface(1, 200, 200)), 4 * std::numbers::pi / 3, 2e-3);
  EXPECT_NEAR(volume(torus_surface(2, 1, 200, 200)), 4 * std::numbers::pi * std::numbers::pi, 2e-2);
}

TEST(SurfaceIndex, WindingAgreesWithTheSolidAngle) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const TriangleSurface& surface : solids()) {
    const SurfaceIndex index(surface);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 X{any(random), any(random), any(random)};
      const double expected = solid_angle_winding(surface, X);
      ASSERT_EQ(index.winding(X), static_cast<int>(std::lround(expected))) << X.x << ' ' << X.y << ' ' << X.z;
      ASSERT_EQ(index.contains(X), std::abs(expected) > 0.5);
    }
  }
}

TEST(SurfaceIndex, RaysThroughEdgesAndVerticesCountOnce) {
  // Every coordinate of the points is one of the vertices': all rays run through vertices, along edges and in faces.
  int decided = 0;
  for (const TriangleSurface& surface : solids()) {
    const SurfaceIndex index(surface);
    std::mt19937 random(2);
    std::uniform_int_distribution<std::size_t> any(0, surface.vertices.size() - 1);
    for (int i = 0; i < 3000; ++i) {
      const Vec3& over = surface.vertices[any(random)];
      const Vec3 X{over.x, over.y, surface.vertices[any(random)].z};
      if (index.location(X) == Location::on_surface) continue;
      ++decided;
      ASSERT_EQ(index.winding(X), static_cast<int>(std::lround(solid_angle_winding(surface, X))));
    }
  }
  EXPECT_GT(decided, 1000);
}

TEST(SurfaceIndex, KnowsWhatIsExactlyOnTheSurface) {
  const TriangleSurface box = box_surface({0, 0, 0}, {3, 1, 1});
  const SurfaceIndex index(box);
  for (const Vec3& X : {Vec3{0, 0.3, 0.3}, Vec3{3, 0.1, 0.9}, Vec3{1, 0, 0.5}, Vec3{1, 1, 0.5}, Vec3{1, 0.5, 0},
                        Vec3{2, 0.25, 1}, Vec3{0, 0, 0}, Vec3{1.5, 1, 1}, Vec3{0, 0.5, 0.5}})
    EXPECT_EQ(index.location(X), Location::on_surface) << X.x << ' ' << X.y << ' ' << X.z;
  EXPECT_EQ(index.location({std::nextafter(3.0, 4), 0.5, 0.5}), Location::outside);
  EXPECT_EQ(index.location({std::nextafter(3.0, 0), 0.5, 0.5}), Location::inside);
  EXPECT_EQ(index.location({1.5, 0.5, std::nextafter(1.0, 2)}), Location::outside);
  EXPECT_EQ(index.location({1.5, 0.5, std::nextafter(1.0, 0)}), Location::inside);
}

TEST(SurfaceIndex, NearestPointIsThatOfAllTriangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  for (const TriangleSurface& surface : solids()) {
    const SurfaceIndex index(surface);
    for (int i = 0; i < 200; ++i) {
      const Vec3 X{any(random), any(random), any(random)};
      double least = 1e9;
      for (Index t = 0; t < surface.size(); ++t) {
        const auto [a, b, c] = surface.corners(t);
        least = std::min(least, norm(X - nearest_on_triangle(X, a, b, c)));
      }
      const NearestPoint nearest = index.nearest(X);
      EXPECT_EQ(nearest.distance, least);
      EXPECT_EQ(norm(X - nearest.X), least);
      EXPECT_TRUE(index.is_nearer_than(least * (1 + 1e-12), X));
      EXPECT_FALSE(index.is_nearer_than(least * (1 - 1e-12), X));
    }
  }
}

TEST(SurfaceIndex, NearestOnTriangleIsNoFartherThanAnySample) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(-1, 1), part(0, 1);
  const auto anywhere = [&] { return Vec3{any(random), any(random), any(random)}; };
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = anywhere(), b = anywhere(), c = anywhere(), X = 2 * anywhere();
    const Vec3 nearest = nearest_on_triangle(X, a, b, c);
    double least = 1e9;
    for (int k = 0; k < 2000; ++k) {
      double u = part(random), v = part(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      least = std::min(least, norm(X - (a + u * (b - a) + v * (c - a))));
    }
    EXPECT_LE(norm(X - nearest), least);
    EXPECT_NEAR(dot(nearest - a, normalized(cross(b - a, c - a))), 0, 1e-12);
    EXPECT_LT(least, norm(X - nearest) + 0.1);
  }
}

TEST(SurfaceIndex, TrianglesNearABoxAreThoseWhoseBoxesMeetIt) {
  const TriangleSurface surface = spiky_surface(9, 20, 30, 0.3);
  const SurfaceIndex index(surface);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Index> found, expected;
  for (int i = 0; i < 200; ++i) {
    Bounds box;
    box.include(Vec3{any(random), any(random), any(random)});
    box.include(box.lower + Vec3{0.2, 0.1, 0.3});
    expected.clear();
    for (Index t = 0; t < surface.size(); ++t)
      if (bounds(surface, t).meets(box)) expected.push_back(t);
    index.triangles_near(box, found);
    EXPECT_EQ(found, expected);
  }
}

TEST(SurfaceIndex, OfNothingAnswersNothing) {
  const TriangleSurface nothing;
  const SurfaceIndex index(nothing);
  EXPECT_EQ(index.location({0, 0, 0}), Location::outside);
  EXPECT_EQ(index.nearest({0, 0, 0}).triangle, -1);
}

}  // namespace
}  // namespace tessera
