#include "tessera/output/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sample.hpp"

namespace tessera {
namespace {

Summary example() {
  Summary s;
  s.version = "0.1.0";
  s.case_file = "punch.toml";
  s.status = "done";
  s.particles = 693;
  s.dt = 1.0 / 3.0;
  s.wall_seconds = {1.0, 2.0, 0.5, 3.0};
  s.step_control = {21, 0.25};
  s.energy.kinetic = 2.0;
  s.energy.initial = 1.0;
  s.energy.scale = 4.0;
  s.energy.internal = 3.0;
  s.energy.contact = 1.0;
  s.energy.largest_contact = 2.0;
  s.energy.largest_strain = 5.0;
  s.momentum.linear = {1.0, 2.0, 3.0};
  s.momentum_change.angular = {0.0, 0.0, 1e-13};
  s.errors["exact"] = {0.01, 0.002, ErrorMeasure::relative};
  s.errors["rest"] = {0.5, 0.7, ErrorMeasure::absolute};
  s.identities["volume"] = 1e-15;
  return s;
}

TEST(Summary, HoldsEveryKey) {
  const auto json = nlohmann::json::parse(to_json(example()));
  for (const char* key : {"version",
                          "case",
                          "status",
                          "particles",
                          "bonds",
                          "boundary_faces",
                          "steps",
                          "dt",
                          "time",
                          "wall_seconds",
                          "particle_steps_per_second",
                          "peak_memory_bytes",
                          "energy",
                          "momentum",
                          "errors",
                          "identities",
                          "max_force_residual",
                          "step_control",
                          "quality",
                          "integration",
                          "warnings"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json.size(), 21u);
  EXPECT_EQ(json["dt"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(json["wall_seconds"],
            (nlohmann::json{{"setup", 1.0}, {"steps", 2.0}, {"time_step", 0.5}, {"output", 3.0}}));
  EXPECT_EQ(json["energy"]["relative_error"], 1.25);
  EXPECT_EQ(json["energy"]["contact_share"], 0.25);
  EXPECT_EQ(json["energy"]["largest_contact_share"], 0.4);
  EXPECT_EQ(json["momentum"]["linear"], (nlohmann::json{1.0, 2.0, 3.0}));
  EXPECT_EQ(json["momentum"]["angular_change"][2], 1e-13);
  EXPECT_EQ(json["errors"]["exact"]["displacement_l2"], 0.01);
  EXPECT_EQ(json["errors"]["exact"]["displacement_l2_measure"], "relative");
  EXPECT_EQ(json["errors"]["rest"]["displacement_l2_measure"], "absolute");
  EXPECT_EQ(json["errors"]["rest"]["displacement_max"], 0.7);
  EXPECT_EQ(json["identities"]["volume"], 1e-15);
}

TEST(Summary, TellsHowCellsAreIntegrated) {
  Summary s = example();
  s.integration = {"cell", 12};
  EXPECT_EQ(nlohmann::json::parse(to_json(s))["integration"],
            (nlohmann::json{{"kind", "cell"}, {"unresolved_cells", 12}}));
}

TEST(Summary, TellsOfMassScalingWhereThereIsSome) {
  Summary s = example();
  s.mass_scaling = {2e-6, 0.5, 0.125, 7, "block", 3, 4.0, 90, 0.001};
  const auto json = nlohmann::json::parse(to_json(s));
  EXPECT_EQ(json["step_control"], (nlohmann::json{{"evaluations", 21}, {"limit", 0.25}}));
  EXPECT_EQ(json["mass_scaling"]["added_share"], 0.125);
  EXPECT_EQ(json["mass_scaling"]["evaluations"], 90);
  EXPECT_EQ(json["mass_scaling"]["kinetic_share"], 0.001);
  EXPECT_EQ(json["mass_scaling"]["most_affected"],
            (nlohmann::json{{"body", "block"}, {"particle", 3}, {"factor", 4.0}}));
  EXPECT_EQ(
      mass_scaling_text(*s.mass_scaling),
      "mass scaling for steps of 2e-06 s: 12.5% of the mass added, to 7 particles (particle 3 of body \"block\" is 4 "
      "times as heavy); kinetic energy at most 0.1% of the energy after the first tenth of the run");
}

TEST(Summary, WarnsOfBondsThatHoldMuchOfTheEnergy) {
  EnergyLedger e;
  EXPECT_EQ(warning_of_bonds(e), "");  // no strain, no share
  e.largest_strain = 10.0;
  e.largest_contact = 2.0;
  EXPECT_EQ(warning_of_bonds(e), "");
  e.largest_contact = 2.9;
  const std::string warning = warning_of_bonds(e);
  EXPECT_EQ(warning.substr(0, 43), "the bonds held 29% of the strain energy (en") << warning;
  Summary s = example();
  EXPECT_EQ(nlohmann::json::parse(to_json(s))["warnings"], nlohmann::json::array());
  s.warnings = {warning};
  EXPECT_EQ(nlohmann::json::parse(to_json(s))["warnings"], nlohmann::json::array({warning}));
}

TEST(Summary, NumbersThatAreNotFiniteAreNull) {
  Summary s = example();
  s.max_force_residual = std::nan("");
  s.particle_steps_per_second = std::numeric_limits<double>::infinity();
  s.energy = {};  // no strain, so no share of the bonds in it
  const auto json = nlohmann::json::parse(to_json(s));
  EXPECT_TRUE(json["max_force_residual"].is_null());
  EXPECT_TRUE(json["particle_steps_per_second"].is_null());
  EXPECT_TRUE(json["energy"]["contact_share"].is_null());
}

TEST(Summary, EmptyListsAreObjectsAndMessagesAppear) {
  Summary s;
  s.message = "step 12: J <= 0 at \xff";
  const auto json = nlohmann::json::parse(to_json(s));
  EXPECT_EQ(json["errors"], nlohmann::json::object());
  EXPECT_EQ(json["identities"], nlohmann::json::object());
  EXPECT_EQ(json["message"].get<std::string>().substr(0, 17), "step 12: J <= 0 a");
}

TEST(Summary, IsWrittenAsAWhole) {
  const sample::Folder folder;
  folder.write("summary.json", "old");
  write_summary(folder.file("summary.json"), example());
  EXPECT_EQ(folder.read("summary.json"), to_json(example()));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Summary, PeakMemoryIsPlausible) {
  EXPECT_GT(peak_memory_bytes(), std::int64_t{1} << 20);
  EXPECT_LT(peak_memory_bytes(), std::int64_t{1} << 40);
}

TEST(DisplacementError, RelativeAndLargest) {
  Snapshot s = sample::snapshot();
  s.volume = {1, 1, 1, 1, 1, 1, 1, 5};
  for (std::size_t a = 0; a < 8; ++a) s.position[a] = s.reference_position[a] + Vec3{1.0, 0.0, 0.0};
  s.position[7].y += 2.0;
  const DisplacementError e = displacement_error(s, [](const Vec3&) { return Vec3{1.0, 0.0, 0.0}; });
  EXPECT_DOUBLE_EQ(e.l2, std::sqrt(5.0 * 4.0 / 12.0));
  EXPECT_DOUBLE_EQ(e.max, 2.0);
  EXPECT_EQ(e.measure, ErrorMeasure::relative);
}

TEST(DisplacementError, AbsoluteWhereTheReferenceIsZero) {
  Snapshot s = sample::snapshot();
  for (std::size_t a = 0; a < 8; ++a) s.position[a] = s.reference_position[a] + Vec3{0.0, 3e-3, 4e-3};
  const DisplacementError e = displacement_error(s, [](const Vec3&) { return Vec3{}; });
  EXPECT_NEAR(e.l2, 5e-3, 1e-17);
  EXPECT_NEAR(e.max, 5e-3, 1e-17);
  EXPECT_EQ(e.measure, ErrorMeasure::absolute);
}

TEST(DisplacementError, TakesFormulasAtTheTimeOfTheState) {
  ReferenceSpec reference;
  reference.displacement = {Formula("0.3*X + 0.2*Y + 0.25*t", {}), Formula("0.1*X + 0.1*Y - 0.25", {}),
                            Formula("2 - 0.1*Z", {})};
  const DisplacementError e = displacement_error(sample::snapshot(2.0), reference);
  EXPECT_LT(e.l2, 1e-15);
  EXPECT_GT(displacement_error(sample::snapshot(1.0), reference).l2, 0.1);
}

TEST(DisplacementError, IsNotANumberWhenAPositionIs) {
  Snapshot s = sample::snapshot();
  s.position[3].x = std::nan("");
  const DisplacementError e = displacement_error(s, [](const Vec3&) { return Vec3{1.0, 0.0, 0.0}; });
  EXPECT_TRUE(std::isnan(e.max));
  EXPECT_TRUE(std::isnan(e.l2));
}

}  // namespace
}  // namespace tessera
