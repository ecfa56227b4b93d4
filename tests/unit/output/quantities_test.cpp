#include "tessera/output/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sample.hpp"

namespace tessera {
namespace {

std::vector<double> first_particle(const char* name) {
  const std::vector<double> all = evaluate(find_quantity(name, {}), sample::snapshot());
  return {all.begin(), all.begin() + find_quantity(name, {}).components()};
}

void expect_near(const std::vector<double>& values, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance) << "component " << i;
}

TEST(Quantities, CauchyStressComesBackFromFirstPiolaKirchhoff) {
  const auto& m = sample::stress.m;
  expect_near(first_particle("cauchy_stress"), {m.begin(), m.end()}, 1e-8);
  expect_near(first_particle("stress"), {m.begin(), m.end()}, 1e-8);
}

TEST(Quantities, DerivedScalars) {
  // s11 = 3, s22 = -2, s33 = 4, s12 = 1, s23 = 0.5, s13 = 0 MPa.
  const double square = 0.5 * (25.0 + 36.0 + 1.0) + 3.0 * (1.0 + 0.25);
  expect_near(first_particle("von_mises"), {1e6 * std::sqrt(square)}, 1e-7);
  expect_near(first_particle("pressure"), {-5e6 / 3.0}, 1e-8);
  expect_near(first_particle("J"), {1.269}, 1e-15);
}

TEST(Quantities, UniaxialStressIsItsOwnVonMises) { EXPECT_DOUBLE_EQ(von_mises(diagonal(0.0, -7.0, 0.0)), 7.0); }

TEST(Quantities, DisplacementIsCurrentMinusReference) {
  const Vec3 X = {0.25, 0.25, 0.25};
  const Vec3 u = sample::F * X + sample::shift - X;
  expect_near(first_particle("displacement"), {u.x, u.y, u.z}, 1e-15);
}

TEST(Quantities, TableHasUniqueNamesUnitsAndSentences) {
  const Snapshot s = sample::snapshot();
  for (const Quantity& q : quantity_table()) {
    EXPECT_EQ(&find_quantity(q.name, {}), &q);
    EXPECT_FALSE(q.unit.empty());
    EXPECT_EQ(q.meaning.back(), '.') << q.name;
    EXPECT_EQ(evaluate(q, s).size(), 8u * static_cast<std::size_t>(q.components())) << q.name;
    EXPECT_EQ(component_suffixes(q).size(), static_cast<std::size_t>(q.components()));
  }
  EXPECT_EQ(quantity_table().size(), 21u);
}

TEST(Quantities, IntegersAreMarked) {
  EXPECT_TRUE(find_quantity("particle_id", {}).is_integer());
  EXPECT_TRUE(find_quantity("body", {}).is_integer());
  EXPECT_FALSE(find_quantity("mass", {}).is_integer());
  EXPECT_EQ(evaluate(find_quantity("particle_id", {}), sample::snapshot())[5], 5.0);
}

TEST(Quantities, DefaultSetBeginsWithReferencePosition) {
  std::vector<std::string> names;
  for (const Quantity* q : field_quantities({}, {})) names.emplace_back(q->name);
  const std::vector<std::string> expected = {"reference_position",
                                             "displacement",
                                             "velocity",
                                             "force",
                                             "deformation_gradient",
                                             "cauchy_stress",
                                             "von_mises",
                                             "pressure",
                                             "J",
                                             "body",
                                             "material"};
  EXPECT_EQ(names, expected);
}

TEST(Quantities, ChosenSetKeepsOrderAndDropsRepetitions) {
  const std::vector<std::string> wanted = {"mass", "stress", "cauchy_stress", "reference_position", "mass"};
  std::vector<std::string> names;
  for (const Quantity* q : field_quantities(wanted, {})) names.emplace_back(q->name);
  EXPECT_EQ(names, (std::vector<std::string>{"reference_position", "mass", "cauchy_stress"}));
}

TEST(Quantities, UnknownNameIsAnErrorWithPlaceAndCure) {
  const std::vector<std::string> wanted = {"displacment"};
  const std::string message = sample::message_of<InputError>([&] {
    field_quantities(wanted, {"case.toml", 7, 12, "output.fields.quantities"});
  });
  EXPECT_EQ(message.find("case.toml:7:12: output.fields.quantities: unknown quantity \"displacment\" "
                         "(did you mean \"displacement\"?); known are reference_position, position,"),
            0u)
      << message;
}

}  // namespace
}  // namespace tessera
