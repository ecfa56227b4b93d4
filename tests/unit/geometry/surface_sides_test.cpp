#include "tessera/geometry/surface_sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include "shapes.hpp"
#include "support/surfaces.hpp"
#include "tessera/geometry/surface_primitives.hpp"
#include "tessera/geometry/surface_transform.hpp"

namespace tessera {
namespace {

using test::box_surface;
using test::expect_contains;
using test::message_of;
using test::somewhere;

SelectionSpec where(const std::string& item) { return {{item}, somewhere()}; }

const SideSummary& summary_of(const std::vector<SideSummary>& sides, const std::string& name) {
  const auto found = std::find_if(sides.begin(), sides.end(), [&](const SideSummary& s) { return s.name == name; });
  if (found == sides.end()) throw std::out_of_range(name);
  return *found;
}

TEST(SurfaceSides, TableOfABox) {
  const std::vector<SideSummary> sides = summarize_sides(box_surface({0, 0, 0}, {3, 2, 1}));
  ASSERT_EQ(sides.size(), 6u);
  const SideSummary& top = summary_of(sides, "+z");
  EXPECT_EQ(top.triangles, 2);
  EXPECT_DOUBLE_EQ(top.area, 6);
  EXPECT_EQ(top.normal, (Vec3{0, 0, 1}));
  EXPECT_LT(norm(top.center - Vec3{1.5, 1, 1}), 1e-15);
}

TEST(SurfaceSides, ASphereHasNoMeanNormal) {
  const std::vector<SideSummary> sides = summarize_sides(sphere_surface(1, 0.01));
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_EQ(sides[0].normal, (Vec3{}));
}

TEST(SurfaceSides, SharpEdgesPartACylinder) {
  TriangleSurface cylinder = cylinder_surface(1, 5, 0.001);
  split_sides_at_edges(cylinder, 30);
  EXPECT_EQ(cylinder.side_names, (std::vector<std::string>{"side1", "side2", "side3"}));
  const std::vector<SideSummary> sides = summarize_sides(cylinder);
  EXPECT_NEAR(sides[0].area, 10 * std::numbers::pi, 0.02);
  EXPECT_LE(norm(sides[1].normal - Vec3{0, 0, -1}), 2e-16);  // of equal areas the one with the smaller z
  EXPECT_LE(norm(sides[2].normal - Vec3{0, 0, 1}), 2e-16);
  split_sides_at_edges(cylinder, 120);
  EXPECT_EQ(cylinder.side_names.size(), 1u);
  split_sides_at_edges(cylinder, 0.1);
  EXPECT_EQ(cylinder.side_names.size(), 2u + static_cast<std::size_t>(cylinder.size()) / 4);
}

TEST(SurfaceSides, NamesDoNotDependOnTheOrderOfTriangles) {
  const TriangleSurface box = transformed(box_surface({0, 0, 0}, {1, 1, 2}), rotation({1, 2, 3}, 33), {5, 6, 7});
  TriangleSurface first = box;
  split_sides_at_edges(first, 30);
  ASSERT_EQ(first.side_names.size(), 6u);
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    std::vector<std::size_t> order(12);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    TriangleSurface other = box;
    for (std::size_t t = 0; t < 12; ++t) {
      other.triangles[t] = box.triangles[order[t]];
      std::rotate(other.triangles[t].begin(), other.triangles[t].begin() + i % 3, other.triangles[t].end());
    }
    split_sides_at_edges(other, 30);
    for (std::size_t t = 0; t < 12; ++t) EXPECT_EQ(other.side[t], first.side[order[t]]);
  }
}

TEST(SurfaceSides, FormulasNameSides) {
  TriangleSurface cylinder = cylinder_surface(1, 5, 0.001);
  const std::vector<NamedSide> named{{"grip", where("Z < 2.5 && Z > 0")}, {"press", where("top")}};
  name_sides(cylinder, named);
  EXPECT_EQ(cylinder.side_names, (std::vector<std::string>{"bottom", "mantle", "grip", "press"}));
  EXPECT_NEAR(summary_of(summarize_sides(cylinder), "press").area, std::numbers::pi, 0.01);

  const std::vector<NamedSide> none{{"a", where("Z > 100")}};
  expect_contains(message_of<InputError>([&] { name_sides(cylinder, none); }),
                  "case.toml:7:3: shape: the side \"a\" takes no");
  const std::vector<NamedSide> twice{{"a", where("Z > 1")}, {"b", where("Z > 2")}};
  expect_contains(message_of<InputError>([&] { name_sides(cylinder, twice); }), "\"a\" and \"b\" both take");
  const std::vector<NamedSide> misspelt{{"a", where("botom")}};
  expect_contains(message_of<InputError>([&] { name_sides(cylinder, misspelt); }), "did you mean \"bottom\"");
}

}  // namespace
}  // namespace tessera
