#include "tessera/geometry/predicates.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <random>

#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

__extension__ using Integer = __int128;
using Point = std::array<std::int64_t, 3>;

int sign(Integer value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

/// Exact for coordinates below 2^40: the determinant stays below 2^125.
int witness3d(const Point& a, const Point& b, const Point& c, const Point& d) {
  Integer p[3], q[3], r[3];
  for (std::size_t i = 0; i < 3; ++i) p[i] = b[i] - a[i], q[i] = c[i] - a[i], r[i] = d[i] - a[i];
  return sign(p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
              p[2] * (q[0] * r[1] - q[1] * r[0]));
}

int witness2d(const Point& a, const Point& b, const Point& c, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  return sign(Integer(b[i] - a[i]) * (c[j] - a[j]) - Integer(b[j] - a[j]) * (c[i] - a[i]));
}

Vec3 real(const Point& p, double scale) {
  return {scale * static_cast<double>(p[0]), scale * static_cast<double>(p[1]), scale * static_cast<double>(p[2])};
}

class Points {
 public:
  explicit Points(unsigned seed) : random_(seed) {}

  Point anywhere(std::int64_t size) {
    std::uniform_int_distribution<std::int64_t> in(-size, size);
    return {in(random_), in(random_), in(random_)};
  }
  /// a + i (b - a) + j (c - a) with small i and j, moved by up to `off` units: in the plane of a, b, c or beside it.
  Point beside(const Point& a, const Point& b, const Point& c, std::int64_t off) {
    std::uniform_int_distribution<std::int64_t> factor(-3, 3), move(-off, off);
    const std::int64_t i = factor(random_), j = factor(random_);
    Point p{};
    for (std::size_t d = 0; d < 3; ++d) p[d] = a[d] + i * (b[d] - a[d]) + j * (c[d] - a[d]) + move(random_);
    return p;
  }

 private:
  std::mt19937 random_;
};

TEST(Predicates, PositiveSideIsWhereTheTriangleRunsCounterClockwise) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(orient3d(a, b, c, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d(a, b, c, {5, 5, -1}), -1);
  EXPECT_EQ(orient3d(a, b, c, {7, -3, 0}), 0);
  EXPECT_EQ(orient2d(a, b, c, 2), 1);
  EXPECT_EQ(orient2d(a, c, b, 2), -1);
  EXPECT_EQ(orient2d(a, b, c, 0), 0);
  EXPECT_TRUE(are_collinear({0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {-7, -7, -7}));
  EXPECT_FALSE(are_collinear({0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {-7, -7, -7.000000000000001}));
}

TEST(Predicates, AgreeWithIntegersForPointsInAndBesidePlanes) {
  Points points(1);
  int flat = 0;
  for (int i = 0; i < 200000; ++i) {
    const Point a = points.anywhere(1LL << 36), b = points.anywhere(1LL << 36), c = points.anywhere(1LL << 36);
    const Point d = points.beside(a, b, c, i % 3);
    const double scale = i % 2 == 0 ? 1.0 : 0x1p-40;
    const int expected = witness3d(a, b, c, d);
    flat += expected == 0;
    ASSERT_EQ(orient3d(real(a, scale), real(b, scale), real(c, scale), real(d, scale)), expected) << i;
    ASSERT_EQ(exact::orient3d(real(a, scale), real(b, scale), real(c, scale), real(d, scale)), expected) << i;
  }
  EXPECT_GT(flat, 60000);
}

TEST(Predicates, AgreeWithIntegersForPointsOnAndBesideLines) {
  Points points(2);
  int straight = 0;
  for (int i = 0; i < 200000; ++i) {
    const Point a = points.anywhere(1LL << 45), b = points.anywhere(1LL << 45);
    const Point c = points.beside(a, b, a, i % 2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int expected = witness2d(a, b, c, axis);
      straight += expected == 0;
      ASSERT_EQ(orient2d(real(a, 0x1p-45), real(b, 0x1p-45), real(c, 0x1p-45), static_cast<int>(axis)), expected) << i;
    }
  }
  EXPECT_GT(straight, 200000);
}

TEST(Predicates, HoldWhereDifferencesRoundAndProductsUnderflow) {
  // A large coordinate beside tiny ones: a - d rounds, so no filter that trusts differences may decide.
  EXPECT_EQ(orient2d({1e16, 1e16, 0}, {-1e16, -1e16, 0}, {1e-16, 1e-16, 0}, 2), 0);
  EXPECT_EQ(orient2d({1e16, 1e16, 0}, {-1e16, -1e16, 0}, {1e-16, 2e-16, 0}, 2), -1);
  const double tiny = 1e-160;
  EXPECT_EQ(orient3d({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}, {0, 0, tiny}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {tiny, tiny, 0}, {0, tiny, tiny}, {tiny, 0, tiny}), 1);
}

/// Points of a box's corners are on one sphere; moved by one unit along the diagonal, they are not.
TEST(Predicates, SphereAgreesWithIntegersForCornersOfBoxes) {
  Points points(3);
  const auto norm2 = [](const Point& p) { return Integer(p[0]) * p[0] + Integer(p[1]) * p[1] + Integer(p[2]) * p[2]; };
  std::array<int, 3> found{};
  for (int i = 0; i < 50000; ++i) {
    const Point low = points.anywhere(1LL << 24), size = points.anywhere(1LL << 20);
    if (size[0] == 0 || size[1] == 0 || size[2] == 0) continue;
    const auto corner = [&](int x, int y, int z) {
      return Point{low[0] + x * size[0], low[1] + y * size[1], low[2] + z * size[2]};
    };
    const Point a = corner(0, 0, 0), b = corner(1, 0, 0), c = corner(0, 1, 0), d = corner(0, 0, 1);
    Point e = corner(i % 2, 1, 1);
    e[0] += i % 3 - 1;
    const Point twice_center{2 * low[0] + size[0], 2 * low[1] + size[1], 2 * low[2] + size[2]};
    const auto radius2 = [&](const Point& p) {
      return norm2({2 * p[0] - twice_center[0], 2 * p[1] - twice_center[1], 2 * p[2] - twice_center[2]});
    };
    const int expected = sign(radius2(a) - radius2(e)) * witness3d(a, b, c, d);
    ++found[static_cast<std::size_t>(expected + 1)];
    for (const double scale : {1.0, 0.1 * 0x1p-20}) {
      if (scale != 1.0 && expected == 0) continue;  // rounded corners are on no sphere
      const auto at = [&](const Point& p) { return real(p, scale); };
      ASSERT_EQ(exact::side_of_sphere(at(a), at(b), at(c), at(d), at(e)), expected) << i;
      ASSERT_EQ(side_of_sphere(at(a), at(b), at(c), at(d), at(e)), expected) << i;
    }
  }
  for (const int n : found) EXPECT_GT(n, 5000);
}

TEST(Predicates, CrossSignSeesParallelLines) {
  Points points(4);
  for (int i = 0; i < 10000; ++i) {
    const Point a = points.anywhere(1LL << 40), c = points.anywhere(1LL << 40), step = points.anywhere(1LL << 10);
    const auto along = [&](const Point& p, std::int64_t n) {
      return Point{p[0] + n * step[0], p[1] + n * step[1], p[2] + n * step[2]};
    };
    Point d = along(c, -5);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(cross_sign(real(a, 1), real(along(a, 3), 1), real(c, 1), real(d, 1), axis), 0);
    ++d[1];  // (b - a) x (d - c) = 3 step x (0, 1, 0)
    EXPECT_EQ(cross_sign(real(a, 1), real(along(a, 3), 1), real(c, 1), real(d, 1), 2), sign(step[0]));
    EXPECT_EQ(cross_sign(real(a, 1), real(along(a, 3), 1), real(c, 1), real(d, 1), 0), sign(-step[2]));
  }
}

TEST(Predicates, CrossingFractionIsAccurateForNearlyParallelSegments) {
  const Vec3 a{0, 0, 1}, b{1, 0, 1}, c{0, 1, 1};
  EXPECT_DOUBLE_EQ(crossing_fraction(a, b, c, {0.2, 0.2, 0}, {0.2, 0.2, 4}), 0.25);
  EXPECT_DOUBLE_EQ(crossing_fraction(a, c, b, {0.2, 0.2, 0}, {0.2, 0.2, 4}), 0.25);
  // One unit in the last place below the plane at one end, three above it at the other.
  const double above = 1.0 + 3 * 0x1p-52, below = 1.0 - 0x1p-52;
  EXPECT_DOUBLE_EQ(crossing_fraction(a, b, c, {-50, 0.3, below}, {70, 0.1, above}), 0.25);
  EXPECT_EQ(crossing_fraction(a, b, c, {-50, 0.3, 1.0}, {70, 0.1, above}), 0.0);
  EXPECT_EQ(crossing_fraction(a, b, c, {-50, 0.3, below}, {70, 0.1, 1.0}), 1.0);
}

TEST(Predicates, ManyThreadsMayAskAtOnce) {
  const int before = parallel::threads();
  parallel::set_threads(4);
  std::atomic<int> wrong = 0;
  parallel::for_each(64 * parallel::block_size, [&](std::int64_t i) {
    Points points(static_cast<unsigned>(i / 64));
    const Point a = points.anywhere(1LL << 36), b = points.anywhere(1LL << 36), c = points.anywhere(1LL << 36);
    const Point d = points.beside(a, b, c, i % 2);
    if (orient3d(real(a, 1), real(b, 1), real(c, 1), real(d, 1)) != witness3d(a, b, c, d)) ++wrong;
  });
  parallel::set_threads(before);
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace tessera
