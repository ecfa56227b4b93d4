#include "tessera/bench/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "tessera/bench/cantilever.hpp"
#include "tessera/bench/cantilever_reference.hpp"
#include "tessera/input/case_file.hpp"

namespace tessera {
namespace {

/// Errors that fall with the square of the spacing and times that grow with its fourth power.
AccuracyRow row(int per_metre) {
  AccuracyRow r;
  r.per_metre = per_metre;
  r.seconds = 1e-3 * std::pow(per_metre, 4);
  r.error = 1.0 / (per_metre * per_metre);
  return r;
}

double seconds_for(double error) { return 1e-3 / (error * error); }

TEST(TimeToError, LiesOnTheLineBetweenTheRowsAroundIt) {
  const std::vector<AccuracyRow> rows = {row(4), row(8), row(16)};
  for (const double error : {0.03, 0.01, 1.0 / 256.0}) {
    const auto time = time_to_error(rows, error);
    ASSERT_TRUE(time);
    EXPECT_NEAR(time->seconds, seconds_for(error), 1e-9 * seconds_for(error));
    EXPECT_FALSE(time->extrapolated);
  }
}

TEST(TimeToError, TakesTheRowsAroundItEvenIfOthersHaveAnotherOrder) {
  std::vector<AccuracyRow> rows = {row(4), row(8), row(16)};
  rows[0].error = 0.9;
  EXPECT_NEAR(time_to_error(rows, 0.01)->seconds, seconds_for(0.01), 1e-9);
}

TEST(TimeToError, SaysWhenItIsExtrapolated) {
  const auto time = time_to_error(std::vector<AccuracyRow>{row(4), row(8)}, 0.01);
  ASSERT_TRUE(time);
  EXPECT_NEAR(time->seconds, seconds_for(0.01), 1e-9 * seconds_for(0.01));
  EXPECT_TRUE(time->extrapolated);
  EXPECT_FALSE(time->upper_bound);
}

TEST(TimeToError, IsAtMostThatOfTheCoarsestBodyIfAllErrLess) {
  const std::vector<AccuracyRow> rows = {row(4), row(8)};
  const auto time = time_to_error(rows, 0.5);
  ASSERT_TRUE(time);
  EXPECT_EQ(time->seconds, rows[0].seconds);
  EXPECT_TRUE(time->upper_bound);
  EXPECT_FALSE(time->extrapolated);
}

TEST(TimeToError, IsUnknownWithoutAnOrder) {
  EXPECT_FALSE(time_to_error(std::vector<AccuracyRow>{row(4)}, 0.01));
  std::vector<AccuracyRow> rows = {row(4), row(8)};
  rows[1].error = rows[0].error;
  EXPECT_FALSE(time_to_error(rows, 0.01));
  rows[1].error = 2.0 * rows[0].error;
  EXPECT_FALSE(time_to_error(rows, 0.01));
  rows[1].error = std::nan("");
  EXPECT_FALSE(time_to_error(rows, 0.01));
}

/// The rows of the reference's file as numbers, by the names of its header.
std::vector<std::map<std::string, double>> reference_file() {
  std::ifstream file(TESSERA_SOURCE_DIR "/tests/data/reference/cantilever.csv");
  std::string line, name;
  std::getline(file, line);
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, name, ',');) names.push_back(name);
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(file, line)) {
    std::istringstream values(line);
    std::string value;
    rows.emplace_back();
    for (const std::string& n : names) {
      std::getline(values, value, ',');
      rows.back()[n] = std::stod(value);
    }
  }
  return rows;
}

TEST(CantileverReference, IsThatOfTheFileUpToOneSecond) {
  const auto rows = reference_file();
  ASSERT_EQ(std::size(cantilever_reference), 101U);
  EXPECT_EQ(cantilever_reference[100].t, 1.0);
  for (std::size_t i = 0; i < std::size(cantilever_reference); ++i) {
    const CantileverReference& r = cantilever_reference[i];
    EXPECT_EQ(r.t, rows[i].at("t"));
    const std::pair<const char*, const double*> points[] = {
        {"corner_top", r.corner_top}, {"in8", r.in8}, {"in16", r.in16}, {"in32", r.in32}};
    for (const auto& [name, x] : points) {
      EXPECT_EQ(x[0], rows[i].at(std::string("x1_") + name)) << i;
      EXPECT_EQ(x[1], rows[i].at(std::string("x3_") + name)) << i;
    }
  }
}

CantileverPath path_of(const double (CantileverReference::*point)[2]) {
  CantileverPath path;
  for (const CantileverReference& r : cantilever_reference) path.x.push_back({(r.*point)[0], 0.3, (r.*point)[1]});
  return path;
}

TEST(PathError, IsZeroOnTheReferenceAndOneForWhatDoesNotMove) {
  EXPECT_EQ(path_error(path_of(&CantileverReference::corner_top), Formulation::delaunay, 8), 0.0);
  EXPECT_EQ(path_error(path_of(&CantileverReference::in8), Formulation::voronoi, 4), 0.0);
  EXPECT_EQ(path_error(path_of(&CantileverReference::in16), Formulation::voronoi, 8), 0.0);
  EXPECT_EQ(path_error(path_of(&CantileverReference::in32), Formulation::voronoi, 16), 0.0);
  CantileverPath still;
  still.x.assign(std::size(cantilever_reference), {6.0, 0.5, 0.5});
  EXPECT_NEAR(path_error(still, Formulation::delaunay, 8), 1.0, 1e-12);
}

/// The example's text without the step that it chooses, so that the default counts.
std::string example_with_default_step() {
  std::ifstream file(TESSERA_SOURCE_DIR "/examples/cantilever/cantilever.toml");
  std::string text, line;
  while (std::getline(file, line))
    if (!line.starts_with("step =") && !line.starts_with("safety =")) text += line + "\n";
  return text;
}

TEST(Cantilever, IsTheExampleWithTheDefaultStep) {
  const CaseFile file =
      read_case_text(example_with_default_step(), "cantilever.toml", {"body.0.particles.jitter=0.2", "time.end=1"});
  const Case& example = file.value;
  const Case ours = cantilever_case(Formulation::delaunay, 8);
  EXPECT_EQ(ours.method.formulation, example.method.formulation);
  EXPECT_EQ(ours.method.boundary, example.method.boundary);
  EXPECT_EQ(ours.method.tetrahedra, example.method.tetrahedra);
  EXPECT_EQ(ours.time.step.index(), example.time.step.index());
  EXPECT_EQ(ours.time.safety, example.time.safety);
  EXPECT_EQ(ours.time.damping, example.time.damping);
  EXPECT_EQ(ours.time.end, example.time.end);
  const Material &m = ours.materials.at(0), &n = example.materials.at(0);
  EXPECT_EQ(std::get<NeoHookean>(m.law).lambda, std::get<NeoHookean>(n.law).lambda);
  EXPECT_EQ(std::get<NeoHookean>(m.law).mu, std::get<NeoHookean>(n.law).mu);
  EXPECT_EQ(m.density, n.density);
  EXPECT_EQ(m.contact.normal, n.contact.normal);
  EXPECT_EQ(m.contact.tangential, n.contact.tangential);
  EXPECT_EQ(m.viscosity.linear, n.viscosity.linear);
  const auto& a = std::get<LatticeSpec>(ours.bodies.at(0).particles.source);
  const auto& b = std::get<LatticeSpec>(example.bodies.at(0).particles.source);
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.jitter, b.jitter);
  EXPECT_EQ(a.seed, b.seed);
  const auto &box = std::get<BoxShape>(ours.bodies[0].shape->kind),
             &other = std::get<BoxShape>(example.bodies[0].shape->kind);
  EXPECT_EQ(box.min, other.min);
  EXPECT_EQ(box.max, other.max);
  const Vec3 X = {4.2, 0.1, -0.3};
  EXPECT_EQ(evaluate(ours.initial.at(0).velocity, 0.0, X), evaluate(example.initial.at(0).velocity, 0.0, X));
  EXPECT_EQ(ours.boundary.at(0).where.items, example.boundary.at(0).where.items);
  EXPECT_EQ(std::get<Condition>(ours.boundary[0].kind), std::get<Condition>(example.boundary.at(0).kind));
}

/// 2.5% with Delaunay tetrahedra and 3.0% with a split lattice, 11.0% with cells: what the probes of the example give.
TEST(Cantilever, HasTheErrorsThatItsExampleHas) {
  const CantileverPath delaunay = run_cantilever(Formulation::delaunay, 4);
  EXPECT_EQ(delaunay.particles, 25 * 5 * 5);
  EXPECT_LT(path_error(delaunay, Formulation::delaunay, 4), 0.035);
  const CantileverPath voronoi = run_cantilever(Formulation::voronoi, 4);
  EXPECT_EQ(voronoi.particles, 24 * 4 * 4);
  EXPECT_NEAR(path_error(voronoi, Formulation::voronoi, 4), 0.110, 0.003);
}

TEST(Cantilever, RefusesSizesWithoutReference) { EXPECT_THROW(run_cantilever(Formulation::voronoi, 5), UsageError); }

}  // namespace
}  // namespace tessera
