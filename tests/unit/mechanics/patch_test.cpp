#include <gtest/gtest.h>

#include "support/balance.hpp"

namespace tessera::test {
namespace {

double distance_to_boundary(const Solid& solid, const Vec3& X) {
  double distance = 1e300;
  for (const Side& side : solid.sides) distance = std::min(distance, std::abs(side.plane.height(X)));
  return distance;
}

/// Largest force on a particle that is not held, relative to the largest force that the boundary exerts.
double residual(const System& s, const Forces& forces, double boundary_force) {
  std::vector<Vec3> f;
  for (const Double4& total : forces.total()) f.push_back(to_vec3(total));
  for (const ParticleConstraint& c : s.d.constraints) {
    Vec3& held = f[static_cast<std::size_t>(c.particle)];
    held -= c.D * held;
  }
  return largest(f) / boundary_force;
}

struct Body {
  std::string name;
  Solid solid;
  std::array<int, 3> counts;
};

std::vector<Body> bodies(Integration i) {
  return {{"box", box({1, 1, 1}), small_cube(i)},
          {"l_block", l_block(), {2 * cells_along(i), 3 * cells_along(i) + 1, cells_along(i)}}};
}

class PatchTest : public testing::TestWithParam<Kind> {};

/// Test A: linear motion everywhere; F is exact and the forces balance.
TEST_P(PatchTest, LinearMotionIsExactAndInEquilibrium) {
  for (const Body& body : bodies(GetParam().integration)) {
    const bool surface_only = GetParam().method == Method::delaunay;
    const Constrain held = [&](const Vec3& X, const Vec3&) {
      const bool inside = body.solid.contains(X, 0.0) && distance_to_boundary(body.solid, X) > 1e-9;
      return surface_only && inside ? Mat3{} : identity();
    };
    const System s = system_of(discretize(GetParam(), body.solid, body.counts, 0.25, 7, held), rubber());
    const std::vector<Vec3> walls = walls_of(s, linear);
    State state = reference_state(s);
    move(state, s, linear);
    Forces forces(s);
    forces.evaluate(state, {walls, {}, {}}, 0.0);
    for (const Tensor& F : forces.deformation_gradient()) {
      const Mat3 error = to_mat3(F) - identity() - patch_gradient;
      EXPECT_LT(std::sqrt(contract(error, error)), 1e-13) << body.name;
    }
    double boundary_force = largest(forces.reactions());
    for (const ParticleConstraint& c : s.d.constraints)
      boundary_force = std::max(boundary_force, norm(to_vec3(forces.total()[static_cast<std::size_t>(c.particle)])));
    EXPECT_LT(residual(s, forces, boundary_force), 1e-10) << body.name;
  }
}

/// Forces of a linear motion on a body whose faces are free are balanced by the traction P N (test C at the exact
/// solution).
double traction_residual(const Kind& kind, const Body& body) {
  const System s = system_of(discretize(kind, body.solid, body.counts, 0.25, 7, nothing), rubber());
  State state = reference_state(s);
  move(state, s, linear);
  const std::vector<NodalForce> loads = loads_of_stress(s, patch_stress());
  Forces forces(s);
  forces.evaluate(state, {{}, loads, {}}, 0.0);
  return residual(s, forces, largest(loads));
}

TEST_P(PatchTest, TractionsBalanceConstantStress) {
  for (const Body& body : bodies(GetParam().integration))
    EXPECT_LT(traction_residual(GetParam(), body), 1e-10) << body.name;
}

INSTANTIATE_TEST_SUITE_P(ExactFormulations, PatchTest,
                         testing::Values(Kind{Method::delaunay}, Kind{Method::consistent}, Kind{Method::quasi_static},
                                         Kind{Method::delaunay, Integration::cell},
                                         Kind{Method::consistent, Integration::cell},
                                         Kind{Method::consistent, Integration::second_order}),
                         [](const auto& param) { return name_of(param.param); });

/// With all faces prescribed the variational forces are those of [V 42], so tests A and B hold.
void expect_equilibrium_with_prescribed_faces(Integration integration) {
  const System s =
      system_of(discretize(Method::variational, box({1, 1, 1}), {3, 3, 3}, 0.25, 7, everything, integration), rubber());
  const std::vector<Vec3> walls = walls_of(s, linear);
  State state = reference_state(s);
  move(state, s, linear);
  Forces forces(s);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  EXPECT_LT(residual(s, forces, largest(forces.reactions())), 1e-10);
}

TEST(PatchTestOfVariationalGhosts, PassesWithPrescribedFaces) {
  for (const Integration integration : {Integration::nodal, Integration::cell})
    expect_equilibrium_with_prescribed_faces(integration);
}

/// The variational ghost formulation does not pass test C on irregular sets: P B^t of free boundary faces is no
/// traction. A large residual is the known behaviour of [V 43], a vanishing one would mean that something else is
/// computed.
TEST(PatchTestOfVariationalGhosts, FailsWithTractionsOnIrregularSets) {
  const double value = traction_residual({Method::variational}, bodies(Integration::nodal)[0]);
  RecordProperty("residual", std::to_string(value));
  EXPECT_GT(value, 0.05);
  EXPECT_LT(value, 2.0);
}

}  // namespace
}  // namespace tessera::test
