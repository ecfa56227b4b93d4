#include <gtest/gtest.h>

#include <algorithm>

#include "tessera/geometry/close_pair.hpp"
#include "tessera/geometry/particles.hpp"

namespace tessera {
namespace {

std::vector<Vec3> grid(int n) {
  std::vector<Vec3> points;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) points.push_back({i + 0.5, j + 0.5, k + 0.5});
  return points;
}

TEST(HilbertOrder, VisitsEveryPointOnce) {
  std::vector<Index> order = hilbert_order(grid(5));
  std::sort(order.begin(), order.end());
  for (Index i = 0; i < 125; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
  EXPECT_TRUE(hilbert_order({}).empty());
  EXPECT_EQ(hilbert_order({{1, 2, 3}}), std::vector<Index>{0});
}

/// The curve's defining property: on a grid of 2^k points a direction each step goes to a direct neighbour.
TEST(HilbertOrder, StepsAreShort) {
  const std::vector<Vec3> points = grid(8);
  const std::vector<Index> order = hilbert_order(points);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Vec3 step = points[static_cast<std::size_t>(order[i])] - points[static_cast<std::size_t>(order[i - 1])];
    EXPECT_DOUBLE_EQ(norm(step), 1.0);
  }
}

TEST(HilbertOrder, EqualPointsKeepTheirOrder) {
  EXPECT_EQ(hilbert_order({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), (std::vector<Index>{0, 1, 2}));
}

TEST(ClosePair, FindsTheFirst) {
  std::vector<Vec3> points = grid(10);
  EXPECT_FALSE(find_close_pair(points, 0.999));
  EXPECT_TRUE(find_close_pair(points, 1.001));
  points.push_back(points[7] + Vec3{0, -1e-4, 0});
  points.push_back(points[3]);
  const auto pair = find_close_pair(points, 2e-4);
  ASSERT_TRUE(pair);
  EXPECT_EQ(*pair, (std::pair<Index, Index>{7, 1000}));
}

TEST(ClosePair, SeesAcrossTheGridOfTheSearch) {
  const double d = 0.01;
  for (const Vec3& step : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0.5, 0.5, -0.5}})
    EXPECT_TRUE(find_close_pair({{0, 0, 0}, 0.99 * d * step}, d));
  EXPECT_FALSE(find_close_pair({{0, 0, 0}, {1.01 * d, 0, 0}}, d));
}

}  // namespace
}  // namespace tessera
