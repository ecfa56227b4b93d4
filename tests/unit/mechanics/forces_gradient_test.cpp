#include <gtest/gtest.h>

#include "support/balance.hpp"

namespace tessera::test {
namespace {

double potential(const System& s, State state, const std::vector<Vec3>& walls) {
  Forces forces(s);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  return forces.sums().internal + forces.sums().contact;
}

struct Variant {
  Method method;
  Constrain constrain;
  std::string name;
  Integration integration = Integration::nodal;
};

/// An irregular cube in a strongly nonlinear motion, with its forces.
class ForcesFromPotential : public testing::TestWithParam<Variant> {
 protected:
  ForcesFromPotential() {
    move(state, s, wavy);
    forces.evaluate(state, {walls, {}, {}}, 0.0);
  }

  const System s = system_of(discretize(GetParam().method, box({1, 1, 1}), small_cube(GetParam().integration), 0.25, 5,
                                        GetParam().constrain, GetParam().integration),
                             rubber());
  const std::vector<Vec3> walls = walls_of(s, wavy);
  State state = reference_state(s);
  Forces forces{s};
};

/// The same for bodies that have boundary nodes.
class ReactionsFromPotential : public ForcesFromPotential {};

/// Forces are minus the derivative of internal and contact energy, with mixed conditions at edges and corners.
TEST_P(ForcesFromPotential, AgreeWithCentralDifferences) {
  const double scale = largest(forces.total());

  const double h = 1e-5;
  for (Index a = 0; a < s.particles(); ++a)
    for (int i = 0; i < 3; ++i) {
      State plus = state, minus = state;
      plus.x[static_cast<std::size_t>(a)][i] += h;
      minus.x[static_cast<std::size_t>(a)][i] -= h;
      const double slope = (potential(s, plus, walls) - potential(s, minus, walls)) / (2.0 * h);
      EXPECT_NEAR(forces.total()[static_cast<std::size_t>(a)][i], -slope, 1e-7 * scale) << "particle " << a;
    }
}

/// The reaction on what holds a node is minus the derivative with respect to the wall's position.
TEST_P(ReactionsFromPotential, AreDerivativesWithRespectToWalls) {
  ASSERT_FALSE(walls.empty());
  const double h = 1e-5;
  for (std::size_t f = 0; f < walls.size(); f += 3)
    for (int i = 0; i < 3; ++i) {
      std::vector<Vec3> plus = walls, minus = walls;
      plus[f][i] += h;
      minus[f][i] -= h;
      const double slope = (potential(s, state, plus) - potential(s, state, minus)) / (2.0 * h);
      EXPECT_NEAR(forces.reactions()[f][i], -slope, 1e-2) << "node " << f;
    }
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (Integration i : {Integration::nodal, Integration::cell}) {
    for (Method m : {Method::delaunay, Method::consistent}) {
      all.push_back({m, nothing, name_of(m) + "_free_" + name_of(i), i});
      all.push_back({m, mixed, name_of(m) + "_mixed_" + name_of(i), i});
      all.push_back({m, everything, name_of(m) + "_held_" + name_of(i), i});
    }
    all.push_back({Method::variational, nothing, "variational_free_" + name_of(i), i});
  }
  for (const auto& [name, constrain] :
       std::vector<std::pair<std::string, Constrain>>{{"free", nothing}, {"mixed", mixed}, {"held", everything}})
    all.push_back({Method::consistent, constrain, "consistent_" + name + "_second_order", Integration::second_order});
  return all;
}

INSTANTIATE_TEST_SUITE_P(
    Conditions, ReactionsFromPotential,
    testing::Values(Variant{Method::consistent, mixed, "mixed"}, Variant{Method::consistent, everything, "held"},
                    Variant{Method::consistent, mixed, "mixed_cell", Integration::cell},
                    Variant{Method::consistent, mixed, "mixed_second_order", Integration::second_order}),
    [](const auto& param) { return param.param.name; });

INSTANTIATE_TEST_SUITE_P(AllFormulations, ForcesFromPotential, testing::ValuesIn(variants()),
                         [](const auto& param) { return param.param.name; });

class VariationalGhosts : public testing::TestWithParam<Variant> {};

/// [V 43] and [V 46] with constraints: the contact force is the full derivative, the internal one is taken with
/// prescribed branch vectors held constant (the walls move with the particle), and D P_a A_ab is added as a reaction.
TEST_P(VariationalGhosts, InternalForceHoldsPrescribedBranches) {
  const System s = system_of(
      discretize(Method::variational, box({1, 1, 1}), {3, 3, 3}, 0.25, 5, GetParam().constrain, GetParam().integration),
      rubber());
  const std::vector<Vec3> walls = walls_of(s, wavy);
  State state = reference_state(s);
  move(state, s, wavy);
  Forces forces(s);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  const Forces::Internal internal = forces.internal(state);
  const auto energies = [&](const State& at, const std::vector<Vec3>& w) {
    State copy = at;
    Forces work(s);
    work.evaluate(copy, {w, {}, {}}, 0.0);
    return work.sums();
  };
  const double h = 1e-5;
  for (Index a = 0; a < s.particles(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    Vec3 reaction;
    for (const BoundaryNode& f : s.d.nodes)
      if (f.owner == a) reaction += f.D * (to_mat3(internal.P[k]) * f.area);
    for (int i = 0; i < 3; ++i) {
      State plus = state, minus = state;
      plus.x[k][i] += h;
      minus.x[k][i] -= h;
      std::vector<Vec3> walls_plus = walls, walls_minus = walls;
      for (std::size_t f = 0; f < walls.size(); ++f)
        if (s.d.nodes[f].owner == a) walls_plus[f][i] += h, walls_minus[f][i] -= h;
      const double contact = (energies(plus, walls).contact - energies(minus, walls).contact) / (2.0 * h);
      const double held = (energies(plus, walls_plus).internal - energies(minus, walls_minus).internal) / (2.0 * h);
      EXPECT_NEAR(forces.total()[k][i], reaction[i] - held - contact, 1e-2) << "particle " << a;
      EXPECT_NEAR(internal.force[k][i], reaction[i] - held, 1e-2) << "particle " << a;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Conditions, VariationalGhosts,
                         testing::Values(Variant{Method::variational, mixed, "mixed"},
                                         Variant{Method::variational, everything, "held"}),
                         [](const auto& param) { return param.param.name; });

class Conservation : public testing::TestWithParam<Kind> {};

/// Free bodies: forces and torques of any state add up to zero.
TEST_P(Conservation, ForcesAndTorquesVanish) {
  const System s =
      system_of(discretize(GetParam(), box({1, 1, 1}), small_cube(GetParam().integration), 0.3, 11, nothing), rubber());
  State state = reference_state(s);
  move(state, s, wavy);
  Forces forces(s);
  forces.evaluate(state, {{}, {}, {}}, 0.0);
  const Resultant sum = resultant(state, forces);
  EXPECT_LT(norm(sum.force), 1e-13 * sum.size);
  EXPECT_LT(norm(sum.torque), 1e-13 * sum.size);
}

/// F(Qx) = Q F(x) for the free body, and so for forces.
TEST_P(Conservation, DeformationGradientIsObjective) {
  const System s =
      system_of(discretize(GetParam(), box({1, 1, 1}), small_cube(GetParam().integration), 0.3, 3, nothing), rubber());
  const double c = std::cos(0.7), z = std::sin(0.7);
  const Mat3 Q{{c, -z, 0, z, c, 0, 0, 0, 1}};
  State state = reference_state(s), turned = state;
  move(state, s, wavy);
  move(turned, s, [&](const Vec3& X) { return Q * wavy(X) + Vec3{3, -2, 1}; });
  Forces first(s), second(s);
  first.evaluate(state, {{}, {}, {}}, 0.0);
  second.evaluate(turned, {{}, {}, {}}, 0.0);
  const double scale = largest(first.total());
  for (std::size_t a = 0; a < s.d.X.size(); ++a) {
    const Mat3 difference = to_mat3(second.deformation_gradient()[a]) - Q * to_mat3(first.deformation_gradient()[a]);
    EXPECT_LT(std::sqrt(contract(difference, difference)), 1e-13);
    EXPECT_LT(norm(to_vec3(second.total()[a]) - Q * to_vec3(first.total()[a])), 1e-12 * scale);
  }
  EXPECT_NEAR(second.sums().internal, first.sums().internal, 1e-12 * first.sums().internal);
}

/// Bodies whose faces are all or partly held by a tool, or free.
class HeldByTools : public testing::TestWithParam<Variant> {
 protected:
  const System s = system_of(discretize(GetParam().method, box({1, 1, 1}), small_cube(GetParam().integration), 0.25, 5,
                                        GetParam().constrain, GetParam().integration),
                             rubber());

  /// Positions in a wavy motion, with walls apart from it, so that boundary bonds are strained; all turned by Q.
  State moved(const Mat3& Q) const {
    State state = reference_state(s);
    move(state, s, [&](const Vec3& X) { return Q * wavy(X); });
    return state;
  }
  std::vector<Vec3> walls(const Mat3& Q) const {
    return walls_of(s, [&](const Vec3& X) { return Q * (wavy(X) + Vec3{0.03 * X.y, -0.05, 0.04 * X.x}); });
  }
};

/// A tool that turns a wholly held face by a right angle and more, together with the body, costs no energy.
TEST_P(HeldByTools, EnergyKnowsNoRotation) {
  ASSERT_FALSE(s.d.nodes.empty());
  const Mat3 Q{{0, -1, 0, 0.6, 0, -0.8, 0.8, 0, 0.6}};
  State state = moved(identity()), turned = moved(Q);
  Forces first(s), second(s);
  first.evaluate(state, {walls(identity()), {}, {}}, 0.0);
  second.evaluate(turned, {walls(Q), {}, {}}, 0.0);
  EXPECT_NEAR(second.sums().contact, first.sums().contact, 1e-12 * first.sums().contact);
  const double scale = largest(first.reactions());
  for (std::size_t f = 0; f < first.reactions().size(); ++f)
    EXPECT_LT(norm(second.reactions()[f] - Q * first.reactions()[f]), 1e-12 * scale) << "node " << f;
}

/// The torque of the reactions is all that changes the body's angular momentum.
TEST_P(HeldByTools, TorqueIsThatOfTheReactions) {
  State state = moved(identity());
  const std::vector<Vec3> tool = walls(identity());
  Forces forces(s);
  forces.evaluate(state, {tool, {}, {}}, 0.0);
  const Resultant sum = resultant(state, forces);
  Vec3 torque = sum.torque;
  for (std::size_t f = 0; f < tool.size(); ++f) torque += cross(tool[f], forces.reactions()[f]);
  EXPECT_LT(norm(torque), 1e-12 * sum.size);
}

Mat3 bottom(const Vec3& C, const Vec3&) { return C.z < 1e-9 ? identity() : Mat3{}; }

INSTANTIATE_TEST_SUITE_P(
    Consistent, HeldByTools,
    testing::Values(Variant{Method::consistent, bottom, "bottom"}, Variant{Method::consistent, everything, "held"},
                    Variant{Method::consistent, bottom, "bottom_cell", Integration::cell},
                    Variant{Method::consistent, bottom, "bottom_second_order", Integration::second_order}),
    [](const auto& param) { return param.param.name; });

INSTANTIATE_TEST_SUITE_P(AllFormulations, Conservation,
                         testing::Values(Kind{Method::delaunay}, Kind{Method::consistent}, Kind{Method::variational},
                                         Kind{Method::delaunay, Integration::cell},
                                         Kind{Method::consistent, Integration::cell},
                                         Kind{Method::consistent, Integration::second_order},
                                         Kind{Method::variational, Integration::cell}),
                         [](const auto& param) { return name_of(param.param); });

}  // namespace
}  // namespace tessera::test
