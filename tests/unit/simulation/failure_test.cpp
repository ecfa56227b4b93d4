#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "sample.hpp"
#include "tessera/output/result_folder.hpp"
#include "tessera/simulation/run.hpp"

namespace tessera::test {
namespace {

/// Runs a case into a fresh folder and gives the folder back.
std::string folder(const std::string& name) {
  const std::string path = testing::TempDir() + "/tessera_" + name;
  std::filesystem::remove_all(path);
  return path;
}

RunOptions into(const std::string& directory) {
  RunOptions o;
  o.directory = directory;
  o.quiet = true;
  return o;
}

nlohmann::json summary_of(const std::string& directory) {
  std::ifstream file(summary_path(directory));
  return nlohmann::json::parse(file);
}

/// The message has step, time, particle, body and position; a good checkpoint of an earlier time is left, and
/// summary.json tells the same story.
void expect_honest_failure(const std::string& message, const std::string& directory, const std::string& reason) {
  EXPECT_TRUE(contains(message, reason)) << message;
  for (const char* part : {"step ", ", t = ", " s: ", " at particle ", " of body \"cube\", now at ("})
    EXPECT_TRUE(contains(message, part)) << message;
  const Checkpoint left = read_checkpoint(checkpoint_path(directory));
  for (double x : left.array("position")) EXPECT_TRUE(std::isfinite(x));
  const nlohmann::json summary = summary_of(directory);
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ(summary["message"], message);
  EXPECT_EQ(summary["time"].get<double>(), left.array("time")[0]);
  const double failed_at = std::stod(message.substr(message.find("t = ") + 4));
  EXPECT_LT(left.array("time")[0], failed_at);
}

void expect_inverted_cell(Method method, Integration integration) {
  Case c = cube_case(method, {3, 3, 3}, 0.0);
  integrate(c, integration);
  c.time.end = 1.0;
  c.time.step = AutoStep{};
  // The lid is pushed through the bottom.
  c.boundary = {condition({"-z"}, Condition::fixed),
                condition({"+z"}, PrescribedDisplacement{components(formulas("0", "0", "-2*t"))})};
  const std::string directory = folder("inverted_" + name_of(method));
  const std::string message = message_of<RunError>([&] { run_case(c, into(directory)); });
  expect_honest_failure(message, directory, "the cell is inverted (J = -");
}

TEST(FailingRuns, SayWhichCellIsInverted) {
  for (Method method : all_methods) expect_inverted_cell(method, Integration::nodal);
  for (Method method : {Method::delaunay, Method::consistent, Method::variational})
    expect_inverted_cell(method, Integration::cell);
  expect_inverted_cell(Method::consistent, Integration::second_order);
}

/// Nothing stops a lid that is driven through the bottom, as long as no cell is inverted: then bonds hold the cells.
TEST(FailingRuns, WarnWhenBondsHoldTheBody) {
  Case c = cube_case(Method::consistent, {3, 3, 3}, 0.2);
  c.time.end = 1.0;
  c.time.step = AutoStep{};
  const auto press = [&](const std::string& speed) {
    c.boundary = {condition({"-y"}, Condition::fixed),
                  condition({"+y"}, PrescribedDisplacement{components(formulas("0", "-" + speed + "*t", "0"))})};
    const std::string directory = folder("pressed");
    testing::internal::CaptureStderr();
    run_case(c, into(directory));
    EXPECT_EQ(contains(testing::internal::GetCapturedStderr(), "tessera: warning: the bonds held"), speed == "1.2");
    const nlohmann::json summary = summary_of(directory);
    EXPECT_EQ(summary["status"], "done");
    return summary["warnings"];
  };
  EXPECT_EQ(press("0.3"), nlohmann::json::array());
  const nlohmann::json warnings = press("1.2");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0].get<std::string>(), "of the strain energy")) << warnings;
}

/// A step above the limit, forced: the highest modes grow from round-off.
TEST(FailingRuns, NoticeGrowingEnergy) {
  for (Method method : {Method::delaunay, Method::consistent, Method::variational}) {
    Case c = cube_case(method);
    c.initial = {initial_velocity(formulas("0.001*Y", "0", "0"))};
    c.time.step = FixedStep{1.0, true};  // so long that the limit below it is estimated as sharply as can be
    const double limit = Running(c).engine.step_control().limit();
    c.time.step = FixedStep{1.015 * limit, true};
    c.time.end = 5000 * limit;
    const std::string directory = folder("growing_" + name_of(method));
    const std::string message = message_of<RunError>([&] { run_case(c, into(directory)); });
    expect_honest_failure(message, directory, "the energy grows out of the ledger");
  }
}

TEST(FailingRuns, RefuseAnInvertedStart) {
  Case c = cube_case(Method::consistent);
  c.initial = {{"", formulas("-2*X", "0", "0"), formulas("0", "0", "0"), {}}};
  const std::string message = message_of<RunError>([&] { Running run(c); });
  EXPECT_TRUE(contains(message, "step 0, t = 0 s: the cell is inverted")) << message;
  EXPECT_TRUE(contains(message, "prescribes at t = 0 must go together")) << message;
}

TEST(FailingRuns, RefuseAStartOfInfiniteEnergy) {
  Case c = cube_case(Method::consistent);
  c.boundary = {condition({"+z"}, PrescribedDisplacement{components(formulas("1e300", "1e300", "1e300"))})};
  EXPECT_TRUE(contains(message_of<RunError>([&] { Running run(c); }), "the energy of the initial state is not finite"));
  EXPECT_TRUE(
      contains(message_of<RunError>([&] { check_case(c, 1); }), "the energy of the initial state is not finite"));
}

TEST(FixedSteps, AboveTheLimitAreRefusedUnlessForced) {
  for (Method method : all_methods) {
    Case c = cube_case(method);
    c.time.origin = {"case.toml", 33, 1, "step"};
    c.time.step = FixedStep{1e-2, false};
    const std::string message = message_of<InputError>([&] { Running run(c); });
    EXPECT_TRUE(contains(message, "case.toml:33")) << message;
    EXPECT_TRUE(contains(message, "spectral limit")) << message;
    c.time.step = FixedStep{1e-2, true};
    EXPECT_NO_THROW(Running run(c));
    c.time.step = FixedStep{1e-4, false};
    EXPECT_NO_THROW(Running run(c));
  }
}

/// auto-spectral at a safety of 0.95 runs on and on while 1.05 of the limit does not (above): energy stays.
TEST(SpectralSteps, AreStableCloseToTheLimit) {
  for (Method method : all_methods) {
    Case c = cube_case(method);
    c.initial = {initial_velocity(formulas("0.5*Y", "0", "0.8*X*Y"))};
    c.time.step = AutoSpectralStep{};
    c.time.safety = 0.95;
    c.time.end = 3.0;
    // With free faces quasi-static is unstable with any step: its stiffness has negative eigenvalues.
    if (method == Method::quasi_static)
      c.boundary = {condition({"-x", "+x", "-y", "+y", "-z", "+z"}, Condition::fixed)};
    Running run(c);
    double largest = 0.0;
    run.engine.prepare();
    const double start = run.engine.energies().kinetic;
    run.engine.advance();
    run.finish([&](const Engine& e) { largest = std::max(largest, e.energies().kinetic); });
    EXPECT_GT(run.engine.steps(), 300) << name_of(method);
    EXPECT_LT(largest, 1.5 * start) << name_of(method);
  }
}

/// end = 0 evaluates the initial state once: forces of the initial displacement, no step.
TEST(EndAtZero, EvaluatesTheForcesOnce) {
  for (Method method : all_methods) {
    Case c = cube_case(method);
    c.time.end = 0.0;
    c.time.step = AutoStep{};
    c.initial = {{"", formulas("1e-3*X*Y", "2e-3*Z", "0"), formulas("1", "0", "0"), {}}};
    c.output.fields.format = FieldFormat::csv;
    const std::string directory = folder("zero_" + name_of(method));
    run_case(c, into(directory));
    const nlohmann::json summary = summary_of(directory);
    EXPECT_EQ(summary["status"], "done");
    EXPECT_EQ(summary["steps"], 0);
    EXPECT_GT(summary["max_force_residual"].get<double>(), 0.0);
    EXPECT_NEAR(summary["energy"]["kinetic"].get<double>(), 500.0, 1e-9);
    std::ifstream history(history_path(directory));
    const std::string text{std::istreambuf_iterator<char>(history), {}};
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
  }
}

}  // namespace
}  // namespace tessera::test
