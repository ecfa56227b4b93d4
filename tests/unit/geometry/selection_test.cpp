#include "tessera/geometry/selection.hpp"

#include <gtest/gtest.h>

#include "shapes.hpp"

namespace tessera {
namespace {

using namespace test;

const std::vector<std::string> kKnown{"-x", "+x", "-y", "+y", "top", "part1.+y"};
constexpr Vec3 kLower{0, 0, 0}, kUpper{1, 2, 3};

Selection select(std::vector<std::string> items) { return {{std::move(items), somewhere()}, kKnown, kLower, kUpper}; }

bool takes(const std::string& item, const Vec3& X, const std::vector<std::string>& names = {}) {
  return select({item}).takes({X, names});
}

std::string error(const std::string& item) {
  return message_of<InputError>([&] { select({item}); });
}

TEST(Selection, ByName) {
  EXPECT_TRUE(takes("+x", {}, {"+x"}));
  EXPECT_TRUE(takes("top", {}, {"edge1", "top"}));
  EXPECT_FALSE(takes("+x", {1, 0, 0}, {"-x"}));
  EXPECT_FALSE(takes("+x", {1, 0, 0}));
  const Selection both = select({"-x", "Y > 1"});
  const std::vector<std::string> names{"-x"};
  EXPECT_TRUE(both.takes({{0, 0, 0}, names}));
  EXPECT_TRUE(both.takes({{0, 1.5, 0}, {}}));
  EXPECT_FALSE(both.takes({{0, 0.5, 0}, {}}));
}

TEST(Selection, ByFormula) {
  EXPECT_TRUE(takes("X > 1/3 && X < 2/3", {0.5, 0, 0}));
  EXPECT_FALSE(takes("X > 1/3 && X < 2/3", {0.7, 0, 0}));
  EXPECT_TRUE(takes("min(X, Y) > 0.25", {0.5, 0.3, 0}));
  EXPECT_TRUE(takes("1", {0.5, 0.3, 0}));
}

TEST(Selection, ByExtremesOfTheBody) {
  EXPECT_TRUE(takes("y == max", {0.5, 2, 0}));
  EXPECT_TRUE(takes("y == max", {0.5, 2 - 2e-9, 0}));
  EXPECT_FALSE(takes("y == max", {0.5, 2 - 4e-9, 0}));
  EXPECT_TRUE(takes("z==min", {0.5, 0.5, 0}));
  EXPECT_TRUE(takes("y == max && X > 1/3 && X < 2/3", {0.5, 2, 1}));
  EXPECT_FALSE(takes("y == max && X > 1/3 && X < 2/3", {0.1, 2, 1}));
  EXPECT_TRUE(takes("(x == min || x == max) && Z > 1", {1, 0, 2}));
  EXPECT_TRUE(takes("x == min||x == max", {1, 0, 2}));
  EXPECT_FALSE(takes("x == min || x == max", {0.5, 0, 2}));
  EXPECT_TRUE(takes("x == min && max(Y, Z) > 1", {0, 0, 2}));
}

TEST(Selection, UnknownNamesAreListed) {
  const std::string message = error("tpo");
  expect_contains(message, "case.toml:7:3: shape: unknown side or surface \"tpo\"");
  expect_contains(message, "did you mean \"top\"?");
  expect_contains(message, "-x, +x, -y, +y, top and part1.+y");
  expect_contains(error("-w"), "unknown side or surface");
  expect_contains(error("part1.+z"), "part1.+y");
  expect_contains(message_of<InputError>([] {
                    Selection({{"top"}, somewhere()}, {}, kLower, kUpper);
                  }),
                  "no named sides");
  expect_contains(message_of<InputError>([] { select({}); }), "the selection is empty");
}

TEST(Selection, BadFormulasKeepTheirColumns) {
  // The text begins at column 3 with its quote, so its first character is at column 4.
  expect_contains(error("y == max && Q > 1"), "case.toml:7:16: ");
  expect_contains(error("Q > 1 && y == max"), "case.toml:7:4: ");
  expect_contains(error("X > 0 && 2*x == min"), "case.toml:7:15: shape: \"x == min\" can only be combined");
  expect_contains(error("x == min + 1"), "can only be combined by && and ||");
  expect_contains(error("y == max && X > 3 m"), "formula \"y == max && X > 3 m\", character 19: ");
  expect_contains(error("x > 1 && y == top"), "case.toml:7:4: shape: formula \"x > 1 && y == top\": \"x\" is known in");
  expect_contains(error("X > 1 && y == top"), "case.toml:7:13: ");
  expect_contains(error("X > 1 && y == top"), "\"y == min\" and \"y == max\" only; the coordinate is \"Y\"");
  expect_contains(error("X > t"), "cannot change with time");
}

}  // namespace
}  // namespace tessera
