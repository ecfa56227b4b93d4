#include "tessera/geometry/shape_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes.hpp"
#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_sides.hpp"

namespace tessera {
namespace {

using test::ball;
using test::box;
using test::cylinder;
using test::expect_contains;
using test::message_of;
using test::polygon;

constexpr double pi = std::numbers::pi;

Shape moved(Shape shape, const ShapeMove& move) {
  shape.move = move;
  return shape;
}

std::vector<std::string> sides(const ShapeSurface& shape) {
  std::vector<std::string> names = shape.surface.side_names;
  std::sort(names.begin(), names.end());
  return names;
}

double area_of(const ShapeSurface& shape, const std::string& side) {
  for (const SideSummary& s : summarize_sides(shape.surface))
    if (s.name == side) return s.area;
  return 0.0;
}

TEST(ShapeSurface, CurvedShapesStandWhereTheyAreToldTo) {
  const ShapeSurface pin = shape_surface(cylinder({1, 2, 3}, {1, 2, 5}, 0.5, 1e-4, "pin"));
  EXPECT_EQ(pin.surface.side_names, (std::vector<std::string>{"bottom", "top", "mantle"}));
  EXPECT_EQ(bounds(pin.surface).lower.z, 3.0);
  EXPECT_EQ(bounds(pin.surface).upper.z, 5.0);
  EXPECT_NEAR(volume(pin.surface), 0.5 * pi, 2e-3);
  EXPECT_EQ(pin.names.at("top"), (std::vector<std::string>{"top", "+z", "pin.top", "pin.+z"}));
  const ShapeSurface slanted = shape_surface(cylinder({1, 2, 3}, {2, 3, 4}, 0.5, 1e-4));
  EXPECT_NEAR(volume(slanted.surface), std::sqrt(3) * pi / 4, 2e-3);
  const SideSummary top = summarize_sides(slanted.surface)[1];
  EXPECT_NEAR(norm(top.center - Vec3{2, 3, 4}), 0, 1e-14);
  EXPECT_NEAR(norm(top.normal - normalized({1, 1, 1})), 0, 1e-14);
  const Shape ring{"", test::somewhere(), TorusShape{{1, 1, 1}, {1, 0, 0}, 2, 0.5, 1e-3}};
  EXPECT_NEAR(volume(shape_surface(ring).surface), pi * pi, 0.02);
  EXPECT_NEAR(bounds(shape_surface(ring).surface).size().x, 1.0, 2e-3);
  const Shape egg{"", test::somewhere(), EllipsoidShape{{5, 0, 0}, {1, 2, 3}, 1e-3}};
  EXPECT_NEAR(volume(shape_surface(egg).surface), 8 * pi, 0.02);
}

TEST(ShapeSurface, DefaultToleranceIsAThousandthOfTheLargestRadius) {
  const Shape pin{"", test::somewhere(), ConeShape{{0, 0, 0}, {0, 0, 1}, {2, 1}, {}}};
  EXPECT_EQ(shape_surface(pin).surface.size(), 4 * 72);
}

TEST(ShapeSurface, MovesScaleTurnAndShift) {
  const ShapeMove move{{1, 2, 1}, Rotation{{0, 0, 1}, 90, {1, 0, 0}}, {0, 0, 7}};
  const ShapeSurface brick = shape_surface(moved(box({0, 0, 0}, {1, 1, 1}), move));
  EXPECT_EQ(bounds(brick.surface).lower, (Vec3{-1, -1, 7}));
  EXPECT_EQ(bounds(brick.surface).upper, (Vec3{1, 0, 8}));
  EXPECT_EQ(volume(brick.surface), 2.0);
}

#if TESSERA_TEST_WITH_CGAL

using test::difference_of;
using test::intersection_of;
using test::union_of;

TEST(ShapeSurface, PlateWithHole) {
  const ShapeSurface plate = shape_surface(
      difference_of({box({-1, -1, 0}, {1, 1, 0.2}, "plate"), cylinder({0, 0, -1}, {0, 0, 1}, 0.4, 1e-3, "hole")}));
  const double hole = volume(shape_surface(cylinder({0, 0, 0}, {0, 0, 0.2}, 0.4, 1e-3)).surface);
  EXPECT_NEAR(volume(plate.surface), 0.8 - hole, 1e-14);
  EXPECT_EQ(sides(plate), (std::vector<std::string>{"hole.mantle", "plate.+x", "plate.+y", "plate.+z", "plate.-x",
                                                    "plate.-y", "plate.-z"}));
  EXPECT_EQ(plate.names.at("plate.+z"), (std::vector<std::string>{"plate.+z", "+z"}));
  EXPECT_EQ(area_of(plate, "plate.-x"), 0.4);
}

// The lid and the ground of a pin that stands on a plate are one plane, also where decimal fractions say 0.1 + 0.2.
TEST(ShapeSurface, PinOnPlate) {
  const ShapeMove lift{{1, 1, 1}, {}, {0, 0, 0.1}};
  for (const ShapeMove& turn : {ShapeMove{}, ShapeMove{{1, 1, 1}, Rotation{{1, 2, 3}, 37, {0.3, 0, 0}}, {1, 2, 3}}}) {
    const Shape pin = moved(cylinder({0, 0, 0.2}, {0, 0, 1}, 0.4, 1e-3, "pin"), lift);
    const ShapeSurface both = shape_surface(moved(union_of({box({-1, -1, 0}, {1, 1, 0.3}, "plate"), pin}), turn));
    const double lid = area_of(shape_surface(pin), "top");
    EXPECT_NEAR(area_of(both, "plate.+z"), 4 - lid, 1e-13);
    EXPECT_EQ(area_of(both, "pin.bottom"), 0.0);
    EXPECT_NEAR(volume(both.surface), 1.2 + 0.8 * lid, 1e-13);
  }
}

// An edge of the polygon lies in the plane of the box's side; its corners were off that by 1e-17.
TEST(ShapeSurface, PolygonsKeepTheNumbersOfTheirCorners) {
  const Shape l = moved(polygon({{0, 0}, {0.5, 0}, {0.5, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {0, 0.5}}, 0.3, -0.1),
                        {{1, 1, 1}, {}, {0.25, -0.2, 0.25}});
  const ShapeSurface rest = shape_surface(difference_of({box({0.25, -0.1, 0.2}, {0.26, 0.1, 0.7}), l}));
  EXPECT_NEAR(volume(rest.surface), 0.01 * 0.2 * 0.25, 1e-15);
}

// Moved by round-off, the pieces of the ring's facets would no longer be flat.
TEST(ShapeSurface, ResultsOfBooleansAreNotPutIntoOtherPlanes) {
  const Shape l = moved(polygon({{0, 0}, {0.5, 0}, {0.5, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {0, 0.5}}, 0.3, -0.1),
                        {{1, 1, 1}, Rotation{{0, 0, 1}, 90, {}}, {}});
  const Shape ring{"", test::somewhere(), TorusShape{{-0.1, 0.2, 0.25}, {1, 0, 0}, 0.5, 0.1, 0.01}};
  const Shape brick = box({-0.3, 0.1, 0.1}, {-0.09999999999999998, 0.4, 0.6});
  const double nested = volume(shape_surface(union_of({l, union_of({brick, ring})})).surface),
               flat = volume(shape_surface(union_of({l, brick, ring})).surface);
  EXPECT_NEAR(nested, flat, 1e-12);
}

TEST(ShapeSurface, PartsTurnedAlikeShareTheirPlanes) {
  const ShapeMove turn{{1, 1, 1}, Rotation{{1, 1, 0}, 30, {}}, {}};
  const ShapeSurface both = shape_surface(
      union_of({moved(box({-1, -1, -1}, {1, 1, 1}), turn), moved(cylinder({1, 0, 0}, {2, 0, 0}, 0.5, 1e-2), turn)}));
  const double lid = area_of(shape_surface(cylinder({0, 0, 0}, {1, 0, 0}, 0.5, 1e-2)), "top");
  EXPECT_NEAR(volume(both.surface), 8 + lid, 1e-13);
  EXPECT_EQ(area_of(both, "part2.bottom"), 0.0);
}

TEST(ShapeSurface, SidesOfNestedParts) {
  Shape base = union_of({box({0, 0, 0}, {2, 2, 1}), cylinder({1, 1, 1}, {1, 1, 2}, 0.5, 1e-2)});
  base.name = "base";
  const ShapeSurface all =
      shape_surface(difference_of({base, ball({0, 0, 0}, 0.5, 1e-2), polygon({{1.5, 1.5}, {3, 1.5}, {3, 3}}, 5, -1)}));
  const auto names = sides(all);
  for (const char* name : {"base.part1.+z", "base.part2.mantle", "part2.mantle", "part3.edge1", "part3.edge3"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  const auto& top = all.names.at("base.part2.top");
  EXPECT_EQ(top, (std::vector<std::string>{"base.part2.top", "+z", "base.+z", "base.part2.+z"}));
}

TEST(ShapeSurface, PartsOfOneNameShareTheirSides) {
  const ShapeSurface plate =
      shape_surface(difference_of({box({0, 0, 0}, {4, 1, 1}), cylinder({1, 0.5, -1}, {1, 0.5, 2}, 0.2, 1e-2, "hole"),
                                   cylinder({3, 0.5, -1}, {3, 0.5, 2}, 0.2, 1e-2, "hole")}));
  const double one = area_of(shape_surface(cylinder({0, 0, 0}, {0, 0, 1}, 0.2, 1e-2)), "mantle");
  EXPECT_NEAR(area_of(plate, "hole.mantle"), 2 * one, 1e-14);
}

TEST(ShapeSurface, HollowBodiesKeepTheirCavity) {
  const ShapeSurface shell =
      shape_surface(difference_of({ball({0, 0, 0}, 1, 1e-2, "outer"), ball({0, 0, 0}, 0.5, 1e-2, "inner")}));
  const double whole = volume(shape_surface(ball({0, 0, 0}, 1, 1e-2)).surface),
               cavity = volume(shape_surface(ball({0, 0, 0}, 0.5, 1e-2)).surface);
  EXPECT_NEAR(volume(shell.surface), whole - cavity, 1e-14);
}

/// A body of random kind, measure, place and direction.
Shape random_shape(unsigned& seed) {
  const auto random = [&seed](double low, double high) {
    seed = seed * 1664525U + 1013904223U;
    return low + (high - low) * (seed >> 8) / double(1U << 24);
  };
  const auto about = [&](double r) { return Vec3{random(-r, r), random(-r, r), random(-r, r)}; };
  Shape shape;
  shape.origin = test::somewhere();
  switch (static_cast<int>(random(0, 5))) {
    case 0:
      shape.kind = BoxShape{about(0.2) - Vec3{0.5, 0.5, 0.5}, about(0.2) + Vec3{0.5, 0.5, 0.5}};
      break;
    case 1:
      shape.kind = ConeShape{about(0.5) - Vec3{0, 0, 1}, about(0.5), {random(0.2, 0.6), random(0.0, 0.5)}, 0.03};
      break;
    case 2:
      shape.kind = EllipsoidShape{about(0.3), Vec3{0.6, 0.6, 0.6} + about(0.3), 0.03};
      break;
    case 3:
      shape.kind = TorusShape{about(0.3), about(1), 0.6, random(0.1, 0.4), 0.03};
      break;
    default:
      shape.kind = PolygonShape{{{0, 0}, {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}}, -0.5, 1};
      break;
  }
  shape.move = {{1, 1, 1}, Rotation{about(1), random(0, 360), about(0.2)}, about(0.2)};
  return shape;
}

bool are_apart(const Shape& a, const Shape& b) {
  try {
    shape_surface(intersection_of({a, b}));
    return false;
  } catch (const InputError& error) {
    return std::string(error.what()).find("nothing in common") != std::string::npos;
  }
}

TEST(ShapeSurface, VolumesOfBooleansAddUp) {
  unsigned seed = 7;
  int meetings = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const Shape a = random_shape(seed), b = random_shape(seed);
    if (are_apart(a, b)) continue;
    ++meetings;
    const double A = volume(shape_surface(a).surface), B = volume(shape_surface(b).surface);
    const double either = volume(shape_surface(union_of({a, b})).surface),
                 both = volume(shape_surface(intersection_of({a, b})).surface),
                 only_a = volume(shape_surface(difference_of({a, b})).surface);
    EXPECT_NEAR(either + both, A + B, 1e-12 * (A + B)) << trial;
    EXPECT_NEAR(only_a + both, A, 1e-12 * A) << trial;
  }
  EXPECT_GT(meetings, 15);
}

std::string error_of(const Shape& shape) {
  return message_of<InputError>([&] { shape_surface(shape); });
}

TEST(ShapeSurface, BooleansThatCannotBe) {
  expect_contains(error_of(difference_of({ball({0, 0, 0}, 1, 0.1), ball({0, 0, 0}, 2, 0.1)})),
                  "case.toml:7:3: shape: covers all");
  expect_contains(error_of(intersection_of({ball({0, 0, 0}, 1, 0.1), ball({3, 0, 0}, 1, 0.1)})), "nothing in common");
  expect_contains(error_of(union_of({box({0, 0, 0}, {1, 1, 1}), polygon({{1, 1}, {2, 1}, {2, 2}}, 1)})),
                  "an edge only");
}

// Parts miss each other by round-off; pieces of the result were missing, which ended the program.
TEST(ShapeSurface, ResultsWithMissingPiecesAreRefused) {
  const Shape l = polygon({{0, 0}, {0.5, 0}, {0.5, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {0, 0.5}}, 0.3, -0.1);
  const auto ring = [](const Vec3& center, const Vec3& axis) {
    return Shape{"", test::somewhere(), TorusShape{center, axis, 0.3, 0.1, 0.01}};
  };
  const Shape rest = difference_of({l, ring({0.5, 0.2, -0.2}, {-0.8549, 0.2577, 0.7936}),
                                    moved(l, {{1, 1, 1}, Rotation{{1, 1, 0}, 46.6049, {}}, {}})});
  const Shape added =
      union_of({box({0, -0.1, 0.25}, {0.01, -0.09000000000000001, 0.26}), ring({0.25, 0, 0.3}, {1, 0, 0})});
  expect_contains(error_of(union_of({rest, added})), "or nearly so");
}

#else

TEST(ShapeSurface, BooleansNeedMeshProcessing) {
  const Shape both = test::union_of({box({0, 0, 0}, {1, 1, 1}), ball({0, 0, 0}, 1, 0.1)});
  expect_contains(message_of<InputError>([&] { shape_surface(both); }), "TESSERA_WITH_CGAL");
}

#endif

}  // namespace
}  // namespace tessera
