#include <gtest/gtest.h>

#include "support/differences.hpp"
#include "tessera/laws/law_lanes.hpp"

namespace tessera::test {
namespace {

struct Variant {
  Integration integration;
  std::size_t material;  // of other_materials(), the last of which flows
};

/// Laws where the energy of a cell is a sum over several points of it.
class LawsAtPoints : public testing::TestWithParam<Variant> {
 protected:
  System cube(const Constrain& constrain, const Material& m) const {
    return system_of(discretize(Method::consistent, box({1, 1, 1}), small_cube(GetParam().integration), 0.25, 5,
                                constrain, GetParam().integration),
                     m);
  }
  Material material() const { return other_materials()[GetParam().material]; }
};

Vec3 further(const Vec3& X) { return wavy(X) + Vec3{0.02 * X.y * X.z, -0.03 * X.x * X.x, 0.02 * X.x}; }

/// With mixed conditions and a history, if there is one: minus the derivative of the (incremental) potential.
TEST_P(LawsAtPoints, ForcesAgreeWithCentralDifferences) {
  const System s = cube(mixed, material());
  const std::vector<Vec3> walls = walls_of(s, wavy);
  State state = reference_state(s);
  Forces forces(s), trial(s);
  move(state, s, wavy);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  forces.commit(state);
  move(state, s, further);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  const auto potential = [&](State moved) {
    trial.evaluate(moved, {walls, {}, {}}, 0.0);
    return trial.sums().internal + trial.sums().contact + trial.sums().dissipated;
  };
  expect_minus_gradient(state, forces, potential);
}

/// The stress that a law answers to two deformations, one after the other.
template <class Law>
Mat3 stress_after(const Law& law, const Mat3& first, const Mat3& second) {
  if constexpr (HasHistory<Law>)
    return law.response(second, law.response(first, {}).after).stress;
  else
    return law.response(second).stress;
}

/// Homogeneous deformations, one after the other, give every cell the stress of the law.
TEST_P(LawsAtPoints, HomogeneousMotionHasTheStressOfTheLaw) {
  const System s = cube(nothing, material());
  const Mat3 first{{1.2, 0.1, 0, -0.05, 0.9, 0.02, 0, 0.1, 0.95}}, second{{0.9, -0.1, 0.1, 0, 1.1, 0, 0.05, 0, 1.05}};
  State state = reference_state(s);
  Forces forces(s);
  for (const Mat3& F : {first, second}) {
    if (F == second) forces.commit(state);
    move(state, s, [&](const Vec3& X) { return F * X; });
    forces.evaluate(state, {}, 0.0);
  }
  const Mat3 expected =
      std::visit([&](const auto& law) { return stress_after(law, first, second); }, s.materials[0].law);
  for (const Tensor& P : forces.internal(state).P) {
    const Mat3 difference = to_mat3(P) - expected;
    EXPECT_LT(std::sqrt(contract(difference, difference) / contract(expected, expected)), 1e-12);
  }
}

std::vector<Variant> all_laws() {
  std::vector<Variant> all;
  for (Integration i : {Integration::cell, Integration::second_order})
    for (std::size_t m = 0; m < other_materials().size(); ++m) all.push_back({i, m});
  return all;
}

std::string name_of_variant(const testing::TestParamInfo<Variant>& variant) {
  const std::vector<std::string> laws{"svk", "mooney", "ogden", "j2"};
  return name_of(variant.param.integration) + "_" + laws[variant.param.material];
}

INSTANTIATE_TEST_SUITE_P(All, LawsAtPoints, testing::ValuesIn(all_laws()), name_of_variant);

class ViscosityAtPoints : public testing::TestWithParam<Integration> {};

/// Viscous forces take over one step twice the work that is booked, which counts half of the stress before, here none.
TEST_P(ViscosityAtPoints, TakesTheWorkThatIsBooked) {
  Material viscous = rubber();
  viscous.viscosity = {0.3, 0.7};
  const auto total = [&](const Material& m, double& dissipated, double& work) {
    const System s = system_of(
        discretize(Method::consistent, box({1, 1, 1}), small_cube(GetParam()), 0.25, 5, nothing, GetParam()), m);
    State before = reference_state(s), state = before;
    move(before, s, wavy);
    move(state, s, further);
    Forces forces(s);
    forces.evaluate(before, {}, 0.0);
    forces.evaluate(state, {}, 1e-3);
    dissipated = forces.sums().dissipated;
    work = 0.0;
    for (std::size_t a = 0; a < s.d.X.size(); ++a) work += dot3(forces.total()[a], state.x[a] - before.x[a]);
  };
  double booked = 0.0, none = 0.0, with = 0.0, without = 0.0;
  total(viscous, booked, with);
  total(rubber(), none, without);
  EXPECT_EQ(none, 0.0);
  EXPECT_GT(booked, 0.0);
  EXPECT_NEAR(without - with, 2.0 * booked, 1e-10 * booked);
}

INSTANTIATE_TEST_SUITE_P(All, ViscosityAtPoints,
                         testing::Values(Integration::nodal, Integration::cell, Integration::second_order),
                         [](const auto& param) { return name_of(param.param); });

}  // namespace
}  // namespace tessera::test
