#include <gtest/gtest.h>

#include "support/differences.hpp"

namespace tessera::test {
namespace {

struct Variant {
  Method method;
  Constrain constrain;
  std::size_t material;
  Volumetric volumetric = Volumetric::standard;
  Integration integration = Integration::nodal;
};

class LawsInBodies : public testing::TestWithParam<Variant> {
 protected:
  LawsInBodies() : walls(walls_of(s, wavy)) {
    move(state, s, wavy);
    forces.evaluate(state, {walls, {}, {}}, 0.0);
    forces.commit(state);  // what has flowed, if anything can, is history from here on
    move(state, s, further);
    forces.evaluate(state, {walls, {}, {}}, 0.0);
  }

  static Vec3 further(const Vec3& X) { return wavy(X) + Vec3{0.02 * X.y * X.z, -0.03 * X.x * X.x, 0.02 * X.x}; }

  double potential(State moved) const {
    Forces trial(s);
    trial.evaluate(moved, {walls, {}, {}}, 0.0);
    return trial.sums().internal + trial.sums().contact + trial.sums().dissipated;
  }

  const System s = system_of(discretize(GetParam().method, box({1, 1, 1}), small_cube(GetParam().integration), 0.25, 5,
                                        GetParam().constrain, GetParam().integration),
                             other_materials()[GetParam().material], small_tiles, GetParam().volumetric);
  std::vector<Vec3> walls;
  State state = reference_state(s);
  Forces forces{s};
};

/// The same where something flows.
class FlowInBodies : public LawsInBodies {};

/// Forces are minus the derivative of the (incremental) potential at the history that is given.
TEST_P(LawsInBodies, AgreeWithCentralDifferences) {
  expect_minus_gradient(state, forces, [this](const State& moved) { return potential(moved); });
}

/// Evaluations leave the state's history alone; commit() takes it over once, and the same stress follows from both.
TEST_P(FlowInBodies, HistoryIsCommittedOnly) {
  const Field<PlasticState> before = state.plastic;
  const Field<Double4> f = forces.total();
  EXPECT_GT(forces.sums().dissipated, 0.0);
  for (int i = 0; i < 3; ++i) forces.evaluate(state, {walls, {}, {}}, 0.0);
  EXPECT_EQ(state.plastic, before);
  for (std::size_t a = 0; a < f.size(); ++a) EXPECT_EQ(to_vec3(forces.total()[a]), to_vec3(f[a]));
  const Field<PlasticState> after = forces.plastic();
  forces.commit(state);
  EXPECT_EQ(state.plastic, after);
  EXPECT_NE(after, before);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  EXPECT_LT(forces.sums().dissipated, 1e-12 * forces.sums().internal);
  for (std::size_t a = 0; a < f.size(); ++a)
    EXPECT_LT(norm(to_vec3(forces.total()[a] - f[a])), 1e-9 * norm(to_vec3(f[a])));
}

/// While flow is held, the stress answers elastically: stiffer than with flow.
TEST_P(FlowInBodies, HeldFlowIsStiffer) {
  forces.commit(state);
  const auto work = [&](Flow flow) {
    Forces f(s, flow);
    State moved = state;
    f.evaluate(moved, {walls, {}, {}}, 0.0);
    const Field<Double4> start = f.total();
    move(moved, s, [](const Vec3& X) { return further(X) + 1e-3 * (further(X) - X); });
    f.evaluate(moved, {walls, {}, {}}, 0.0);
    double sum = 0.0;
    for (std::size_t a = 0; a < start.size(); ++a) sum -= dot3(f.total()[a] - start[a], moved.x[a] - state.x[a]);
    return sum;
  };
  EXPECT_GT(work(Flow::held), 1.05 * work(Flow::allowed));
}

std::vector<Variant> variants(std::size_t first) {
  std::vector<Variant> all;
  for (std::size_t m = first; m < other_materials().size(); ++m) {
    all.push_back({Method::delaunay, mixed, m});
    all.push_back({Method::consistent, mixed, m});
    all.push_back({Method::variational, nothing, m});
    all.push_back({Method::delaunay, nothing, m, Volumetric::averaged});
    all.push_back({Method::consistent, mixed, m, Volumetric::averaged});
    all.push_back({Method::delaunay, mixed, m, Volumetric::averaged, Integration::cell});
    all.push_back({Method::consistent, mixed, m, Volumetric::averaged, Integration::cell});
    all.push_back({Method::consistent, mixed, m, Volumetric::averaged, Integration::second_order});
  }
  return all;
}

std::string name_of_variant(const testing::TestParamInfo<Variant>& variant) {
  const std::vector<std::string> names{"svk", "mooney", "ogden", "j2"};
  const std::string averaged = variant.param.volumetric == Volumetric::averaged ? "_averaged" : "";
  const std::string where =
      variant.param.integration == Integration::nodal ? "" : "_" + name_of(variant.param.integration);
  return name_of(variant.param.method) + "_" + names[variant.param.material] + averaged + where;
}

INSTANTIATE_TEST_SUITE_P(AllLaws, LawsInBodies, testing::ValuesIn(variants(0)), name_of_variant);
INSTANTIATE_TEST_SUITE_P(Plastic, FlowInBodies, testing::ValuesIn(variants(3)), name_of_variant);

}  // namespace
}  // namespace tessera::test
