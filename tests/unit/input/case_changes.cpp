#include "tessera/input/case_changes.hpp"

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

using Lines = std::vector<std::string>;

TEST(CaseChanges, NameTheKeyAndBothValues) {
  const std::string before = "title = \"A\"\n[time]\nend = 1\nsafety = 0.8\n[[material]]\nyoung = 1e6\n";
  EXPECT_EQ(case_changes(before, "old", before), Lines{});
  const std::string now =
      "title = \"A\"\n[time]\nend = 2\ndamping = 3\n[[material]]\nyoung = 2e6\n[[material]]\nyoung = 5\n";
  EXPECT_EQ(case_changes(before, "old", now),
            (Lines{"time.end was 1, is 2", "time.safety was 0.8, is missing", "time.damping was missing, is 3",
                   "material.0.young was 1000000, is 2000000", "material.1 was missing, is { young = 5 }"}));
}

TEST(CaseChanges, CompareListsItemByItem) {
  EXPECT_EQ(case_changes("u = [0, \"-t\"]", "old", "u = [0, \"-2*t\", 1]"),
            (Lines{"u.1 was \"-t\", is \"-2*t\"", "u.2 was missing, is 1"}));
  EXPECT_EQ(case_changes("u = [0]", "old", "u = 3"), Lines{"u was [0], is 3"});
}

TEST(CaseChanges, SayWhichTextIsDamaged) {
  try {
    case_changes("title = ", "out/case.toml", "");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("out/case.toml:1:", 0), 0u) << error.what();
  }
}

}  // namespace
}  // namespace tessera
