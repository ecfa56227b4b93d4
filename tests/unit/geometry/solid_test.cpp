#include "tessera/geometry/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "shapes.hpp"

namespace tessera {
namespace {

using namespace test;
using Names = std::vector<std::string>;

std::map<std::string, int> count_names(const Solid& solid) {
  std::map<std::string, int> count;
  for (const Side& side : solid.sides)
    for (const std::string& name : side.names) ++count[name];
  return count;
}

const Side& side_called(const Solid& solid, const std::string& name) {
  for (const Side& side : solid.sides)
    if (std::find(side.names.begin(), side.names.end(), name) != side.names.end()) return side;
  throw std::runtime_error("no side is called " + name);
}

TEST(Solid, BoxHasSixNamedSides) {
  const Solid solid = build_solid(box({1, 2, 3}, {2, 4, 6}));
  EXPECT_EQ(side_names(solid), (Names{"+x", "+y", "+z", "-x", "-y", "-z"}));
  ASSERT_EQ(solid.pieces.size(), 1U);
  EXPECT_EQ(solid.volume, 6.0);
  EXPECT_EQ(solid.lower, (Vec3{1, 2, 3}));
  EXPECT_EQ(solid.upper, (Vec3{2, 4, 6}));
  EXPECT_EQ(side_called(solid, "-y").plane.normal, (Vec3{0, -1, 0}));
  EXPECT_EQ(side_called(solid, "-y").plane.offset, -2.0);
  EXPECT_TRUE(solid.contains({1.5, 3, 4}, 0));
  EXPECT_FALSE(solid.contains({2.01, 3, 4}, 0));
  EXPECT_TRUE(solid.contains({2.01, 3, 4}, 0.02));
  EXPECT_FALSE(solid.contains({1.5, 3, 6}, -1e-3));
}

TEST(Solid, NamedShapeNamesItsSidesToo) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}, "brick"));
  EXPECT_EQ(side_called(solid, "brick.+z").names, (Names{"+z", "brick.+z"}));
}

TEST(Solid, LBlockFromBoxesAndFromAPolygonFillTheSameSpace) {
  const Solid a = build_solid(l_union()), b = build_solid(l_polygon());
  EXPECT_DOUBLE_EQ(a.volume, 117.0);
  EXPECT_DOUBLE_EQ(b.volume, 117.0);
  for (double x = -0.5; x < 7; x += 0.73)
    for (double y = -0.5; y < 11; y += 0.73) {
      const bool is_inside = x > 0 && y > 0 && ((x < 6 && y < 3) || (x < 3 && y < 10));
      EXPECT_EQ(a.contains({x, y, 1.5}, 0), is_inside) << x << " " << y;
      EXPECT_EQ(b.contains({x, y, 1.5}, 0), is_inside) << x << " " << y;
    }
}

TEST(Solid, LBlockSidesAreReachableByPlainNames) {
  for (const Shape& shape : {l_union(), l_polygon()}) {
    const Solid solid = build_solid(shape);
    EXPECT_EQ(solid.sides.size(), 8U);
    EXPECT_EQ(side_called(solid, "+y").plane.offset, 10.0);
    EXPECT_EQ(side_called(solid, "+x").plane.offset, 6.0);
  }
  EXPECT_EQ(side_called(build_solid(l_union()), "part1.+y").plane.offset, 3.0);
  EXPECT_EQ(side_called(build_solid(l_union()), "part2.+x").plane.offset, 3.0);
  const Solid polygon = build_solid(l_polygon());
  EXPECT_EQ(side_called(polygon, "edge3").plane.offset, 3.0);
  EXPECT_EQ(side_called(polygon, "edge3").plane.normal, (Vec3{0, 1, 0}));
  EXPECT_EQ(side_called(polygon, "edge1").names, (Names{"-y", "edge1"}));
}

TEST(Solid, HoleIsNamedByTheFacesThatItLeaves) {
  const Solid solid = build_solid(difference_of({box({0, 0, 0}, {3, 3, 1}), box({1, 1, -1}, {2, 2, 2}, "hole")}));
  EXPECT_DOUBLE_EQ(solid.volume, 8.0);
  EXPECT_EQ(solid.pieces.size(), 8U);
  const Side& side = side_called(solid, "hole.-x");
  EXPECT_EQ(side.plane.normal, (Vec3{1, 0, 0}));  // out of the solid, into the hole
  EXPECT_EQ(side.plane.offset, 1.0);
  EXPECT_EQ(count_names(solid).count("hole.+z"), 0U);
  EXPECT_EQ(count_names(solid)["+z"], 1);
}

TEST(Solid, NestedPartsAreNamedByTheirPlace) {
  const Shape ring = difference_of({box({0, 0, 0}, {3, 3, 1}), box({1, 1, 0}, {2, 2, 1})});
  const Solid solid = build_solid(union_of({ring, box({3, 0, 0}, {4, 1, 1}, "tail")}));
  EXPECT_DOUBLE_EQ(solid.volume, 9.0);
  EXPECT_EQ(side_called(solid, "part1.part2.+x").plane.offset, -2.0);
  EXPECT_EQ(side_called(solid, "tail.+x").names, (Names{"+x", "tail.+x"}));
  EXPECT_EQ(side_called(solid, "part1.+x").plane.offset, 3.0);
}

TEST(Solid, FlushUnnamedBoxesMakeOneSide) {
  const Solid solid = build_solid(union_of({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})}));
  EXPECT_EQ(solid.sides.size(), 6U);
  EXPECT_EQ(solid.pieces.size(), 1U);
}

TEST(Solid, CoordinatesEqualToRoundoffAreOne) {
  const double third = 0.1 * 3;  // not the same number as 0.3
  ASSERT_NE(third, 0.3);
  const Solid solid = build_solid(union_of({box({0, 0, 0}, {third, 1, 1}), box({0.3, 0, 0}, {1, 0.5, 1})}));
  EXPECT_EQ(solid.pieces.size(), 3U);
  EXPECT_NEAR(solid.volume, 0.65, 1e-15);
}

/// Every wall must be wholly boundary or wholly shared: its outer side is all empty, or all in other pieces.
TEST(Solid, PiecesConform) {
  const Shape star = polygon({{0, 0}, {4, 0.3}, {5, 3}, {3, 1.5}, {2.5, 4}, {1, 1.2}, {-1, 3}}, 1.0);
  const Shape cavity = difference_of({box({0, 0, 0}, {3, 3, 3}), box({1, 1, 1}, {2, 2, 2})});
  for (const Shape& shape : {l_union(), l_polygon(), star, cavity}) {
    const Solid solid = build_solid(shape);
    for (const ConvexPiece& piece : solid.pieces)
      for (const ConvexPiece::Wall& wall : piece.walls)
        for (int sample = 0; sample < 400; ++sample) {
          const auto part = [&](int k) { return (static_cast<double>((sample * k) % 401) + 0.5) / 401.0; };
          const Vec3 size = piece.upper - piece.lower;
          Vec3 X = piece.lower + Vec3{part(1) * size.x, part(31) * size.y, part(157) * size.z};
          X -= wall.plane.height(X) * wall.plane.normal;
          const bool is_on_wall = std::all_of(piece.walls.begin(), piece.walls.end(),
                                              [&](const auto& w) { return &w == &wall || w.plane.height(X) < -1e-6; });
          if (!is_on_wall) continue;
          EXPECT_EQ(solid.contains(X + 1e-9 * wall.plane.normal, 0), wall.side < 0);
        }
  }
}

TEST(Solid, PolygonMayRunEitherWayRound) {
  const Solid left = build_solid(polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 1.0, 5.0));
  const Solid right = build_solid(polygon({{0, 0}, {0, 1}, {2, 1}, {2, 0}}, 1.0, 5.0));
  EXPECT_EQ(left.volume, 2.0);
  EXPECT_EQ(right.volume, 2.0);
  EXPECT_EQ(side_called(left, "edge2").plane.normal.x, 1.0);
  EXPECT_EQ(side_called(right, "edge1").plane.normal.x, -1.0);
  EXPECT_EQ(side_called(right, "edge3").plane.normal.x, 1.0);
  EXPECT_EQ(side_called(left, "-z").plane.offset, -5.0);
  EXPECT_EQ(right.sides[0].names, (Names{"-x", "edge1"}));
}

TEST(Solid, PolygonMayHaveCornersOnAStraightEdge) {
  const Solid solid = build_solid(polygon({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}, 1.0));
  EXPECT_DOUBLE_EQ(solid.volume, 2.0);
  EXPECT_EQ(side_called(solid, "edge1").plane.normal, side_called(solid, "edge2").plane.normal);
  for (const ConvexPiece& piece : solid.pieces) EXPECT_LT(piece.upper.x - piece.lower.x, 2.1);
}

TEST(Solid, IntersectionsKeepWhatIsCommon) {
  const Solid solid = build_solid(
      intersection_of({box({0, 0, 0}, {2, 2, 2}, "a"), box({1, 1, -1}, {3, 3, 1}), box({0, 0, 0}, {9, 9, 9})}));
  EXPECT_EQ(solid.volume, 1.0);
  EXPECT_EQ(solid.lower, (Vec3{1, 1, 0}));
  EXPECT_EQ(solid.upper, (Vec3{2, 2, 1}));
  const std::vector<std::string> names = side_names(solid);
  EXPECT_NE(std::find(names.begin(), names.end(), "a.+x"), names.end());
}

TEST(Solid, MovesStretchAndShiftBoxesAndPolygons) {
  Shape both = union_of({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})});
  std::get<UnionShape>(both.kind).parts[1].move = {{2, 1, 1}, {}, {0, 0, 0.5}};  // 2 <= x <= 4
  both.move = {{1, 2, 3}, {}, {10, 20, 30}};
  const Solid solid = build_solid(both);
  EXPECT_EQ(solid.volume, 6.0 + 12.0);
  EXPECT_EQ(solid.lower, (Vec3{10, 20, 30}));
  EXPECT_EQ(solid.upper, (Vec3{14, 22, 34.5}));
  Shape l = l_polygon();
  const double before = build_solid(l).volume;
  l.move = {{1, 2, 0.5}, {}, {0, 0, 1}};
  EXPECT_NEAR(build_solid(l).volume, before, 1e-13 * before);
  EXPECT_EQ(build_solid(l).lower.z, 1.0);
}

std::string error_of(const Shape& shape) {
  return message_of<InputError>([&] { build_solid(shape); });
}

TEST(SolidErrors, SayWhereAndWhat) {
  expect_contains(error_of(box({0, 0, 0}, {1, 0, 1})),
                  "case.toml:7:3: shape: the box is empty: min y = 0 m, max y = 0 m");
  expect_contains(error_of(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 1.0)), "edges 1 and 3 of the polygon cross");
  expect_contains(error_of(polygon({{0, 0}, {1, 0}, {1, 1}, {0, 0}}, 1.0)), "points 1 and 4 of the polygon coincide");
  expect_contains(error_of(polygon({{0, 0}, {1, 0}}, 1.0)), "at least three points, not 2");
  expect_contains(error_of(polygon({{0, 0}, {1, 0}, {1, 1}}, -1.0)), "thickness must be positive");
  expect_contains(error_of(polygon({{0, 0}, {1, 0}, {2, 0}}, 1.0)), "lie on each other");
  expect_contains(error_of(polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, 1.0)),
                  "edges 1 and 3 of the polygon cross or touch");
  expect_contains(error_of(difference_of({box({0, 0, 0}, {1, 1, 1}), box({-1, -1, -1}, {2, 2, 2})})), "leave nothing");
  expect_contains(error_of(intersection_of({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})})), "leave nothing");
  expect_contains(error_of(union_of({l_polygon(), box({0, 0, 0}, {1, 1, 1})})), "only boxes and polygons");
  expect_contains(error_of(union_of({})), "at least one part");
}

}  // namespace
}  // namespace tessera
