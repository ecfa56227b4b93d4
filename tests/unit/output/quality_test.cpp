#include "tessera/output/quality.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tessera {
namespace {

Quality example() {
  Quality q;
  q.smallest_volume = 1e-9;
  q.mean_volume = 2e-9;
  q.largest_volume = 4e-9;
  q.fewest_faces = 9;
  q.most_faces = 21;
  q.mean_faces = 15.25;
  q.shortest_bond = 1e-4;
  q.typical_bond = 1e-3;
  q.at_shortest_bond = {"block", 17, {0.5, 0.25, 0}};
  q.shortest_steps = {{{"block", 17, {0.5, 0.25, 0}}, 0.125}, {{"lid", 3, {1, 2, 3}}, 0.5}};
  return q;
}

TEST(Quality, IsOneTableForPeople) {
  EXPECT_EQ(
      to_text(example()),
      "cells            volumes 1e-09 to 4e-09, mean 2e-09 m3; faces 9 to 21, mean 15.2\n"
      "                 shortest bonds 0.0001, typical 0.001 m: particle 17 of body \"block\" at (0.5, 0.25, 0) m\n"
      "shortest steps   of single particles, in shares of the typical one\n"
      "  0.12           particle 17 of body \"block\" at (0.5, 0.25, 0) m\n"
      "  0.50           particle 3 of body \"lid\" at (1, 2, 3) m\n");
}

TEST(Quality, WarnsOfFewParticlesWithACure) {
  Quality q = example();
  q.few = 1;
  EXPECT_NE(to_text(q).find("warning: 1 particle shortens the time step of all others; move or leave it out"),
            std::string::npos);
  q.few = 2;
  EXPECT_NE(to_text(q).find("warning: 2 particles shorten the time step of all others; move or leave them out"),
            std::string::npos);
}

TEST(Quality, IsAnObjectForPrograms) {
  Quality q = example();
  EXPECT_FALSE(to_json(q).contains("warning"));
  q.few = 1;
  const auto json = to_json(q);
  EXPECT_EQ(json["volume"]["max"], 4e-9);
  EXPECT_EQ(json["faces"]["mean"], 15.25);
  EXPECT_EQ(json["shortest_bond"]["particle"], 17);
  EXPECT_EQ(json["shortest_bond"]["length"], 1e-4);
  EXPECT_EQ(json["shortest_steps"][1]["body"], "lid");
  EXPECT_EQ(json["shortest_steps"][0]["share"], 0.125);
  EXPECT_TRUE(json.contains("warning"));
}

}  // namespace
}  // namespace tessera
