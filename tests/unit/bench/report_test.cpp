#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tessera/bench/bench.hpp"

namespace tessera {
namespace {

AccuracyForTime accuracy(std::optional<TimeToError> time) {
  return {"delaunay", "nodal", 2, {{4, 625, 3000, 0.5, 0.0245}, {8, 3969, 6000, 12.5, 0.0177}}, time};
}

BenchReport report() {
  BenchReport r;
  r.triad_bytes_per_second[2] = 20e9;
  BenchRow row;
  row.particles = 1000;
  row.threads = 2;
  row.formulation = "voronoi";
  row.particle_steps_per_second = 5e6;
  row.integration = "nodal";
  row.stages = {{"strain", 1.0}, {"contact", 1.0}, {"stress", 1.0}, {"force", 1.0}, {"step", 5.0}, {"cells", 2.5}};
  r.rows = {row};
  r.accuracy = {accuracy(TimeToError{42.0, true})};
  return r;
}

TEST(BenchReport, JsonHasTheKeysThatOthersRead) {
  const auto j = nlohmann::json::parse(to_json(report()));
  EXPECT_EQ(j.at("triad_bytes_per_second").at("2"), 20e9);
  for (const char* key : {"particles", "threads", "formulation", "integration", "particle_steps_per_second",
                          "bytes_per_particle_step", "bytes_per_particle", "setup_seconds", "stages"})
    EXPECT_TRUE(j.at("results").at(0).contains(key)) << key;
  const auto& a = j.at("accuracy_for_time").at(0);
  EXPECT_EQ(a.at("formulation"), "delaunay");
  EXPECT_EQ(a.at("integration"), "nodal");
  EXPECT_EQ(a.at("rows").at(1).at("per_metre"), 8);
  EXPECT_EQ(a.at("rows").at(1).at("error"), 0.0177);
  EXPECT_EQ(a.at("seconds_to_wanted_error"), 42.0);
  EXPECT_EQ(a.at("extrapolated"), true);
}

TEST(BenchReport, JsonOfOnePartHasNothingOfTheOther) {
  BenchReport speed = report(), only_accuracy = report();
  speed.accuracy.clear();
  only_accuracy.rows.clear();
  EXPECT_FALSE(nlohmann::json::parse(to_json(speed)).contains("accuracy_for_time"));
  EXPECT_TRUE(nlohmann::json::parse(to_json(only_accuracy)).at("results").empty());
}

TEST(BenchReport, AnUnknownTimeIsNull) {
  BenchReport r = report();
  r.accuracy = {accuracy(std::nullopt)};
  const auto a = nlohmann::json::parse(to_json(r)).at("accuracy_for_time").at(0);
  EXPECT_TRUE(a.at("seconds_to_wanted_error").is_null());
  EXPECT_NE(to_table(r).find("no estimate"), std::string::npos);
}

std::vector<std::string> names(const BenchOptions& options) {
  std::vector<std::string> result;
  for (const MethodSpec& m : methods_of_accuracy(options))
    result.push_back((m.formulation == Formulation::delaunay ? "delaunay " : "voronoi ") + name_of(m.integration));
  return result;
}

TEST(Bench, MeasuresTheAccuracyOfAllIntegrationsUnlessAskedForOne) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({}),
            (Names{"delaunay nodal", "delaunay cell", "voronoi nodal", "voronoi cell", "voronoi second-order"}));
  BenchOptions options;
  options.integration = Integration::second_order;
  EXPECT_EQ(names(options), Names{"voronoi second-order"});
  options.integration = Integration::cell;
  options.formulation = Formulation::delaunay;
  EXPECT_EQ(names(options), Names{"delaunay cell"});
}

TEST(BenchReport, TableNamesTheIntegration) {
  EXPECT_NE(to_table(report()).find("delaunay         nodal        2          4"), std::string::npos)
      << to_table(report());
}

TEST(BenchReport, TableHasTheMethodAndItsStages) {
  const std::string text = to_table(report());
  EXPECT_NE(text.find("steps of voronoi, nodal:"), std::string::npos) << text;
  EXPECT_NE(text.find("  strain  contact  stress   force\n"), std::string::npos) << text;
  EXPECT_NE(text.find("     20%      20%     20%     20%\n"), std::string::npos) << text;
  EXPECT_NE(text.find("   cells  B/particle\n"), std::string::npos) << text;
  EXPECT_NE(text.find("    2.50     unknown\n"), std::string::npos) << text;
}

/// The stages of second order are those of other methods, in the order in which they come.
TEST(BenchReport, TableHasTheStagesOfSecondOrder) {
  BenchReport r = report();
  r.rows[0].integration = "second-order";
  r.rows[0].stages = {{"strain", 4.0}, {"contact", 1.0}, {"stress", 2.0}, {"force", 2.0},
                      {"rims", 0.5},   {"kick", 0.5},    {"step", 10.0}};
  const std::string text = to_table(r);
  EXPECT_NE(text.find("  strain  contact  stress   force    rims    kick\n"), std::string::npos) << text;
  EXPECT_NE(text.find("     40%      10%     20%     20%      5%      5%\n"), std::string::npos) << text;
}

TEST(BenchReport, TableSaysWhatIsExtrapolated) {
  EXPECT_NE(to_table(report()).find("42 s (extrapolated)"), std::string::npos);
  BenchReport r = report();
  r.accuracy = {accuracy(TimeToError{42.0, false})};
  EXPECT_EQ(to_table(r).find("extrapolated"), std::string::npos);
  EXPECT_EQ(to_table(r).find("at most"), std::string::npos);
  r.accuracy = {accuracy(TimeToError{42.0, false, true})};
  EXPECT_NE(to_table(r).find("at most 42 s"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json(r)).at("accuracy_for_time").at(0).at("upper_bound"), true);
}

}  // namespace
}  // namespace tessera
