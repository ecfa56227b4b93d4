#include <gtest/gtest.h>

#include "support/ghost_reference.hpp"

namespace tessera::test {
namespace {

Material sample_material() {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  return m;
}

struct Conditions {
  std::string name;
  Constrain constrain;
};

/// A reference and the library's forces for the same irregular body and positions.
struct Setting {
  VoronoiBody body;
  GhostReference reference;
  std::vector<Vec3> x, walls;
  Material material = sample_material();
  System s;
  State state;
  Forces forces;

  Setting(Method method, const Constrain& constrain)
      : body(voronoi_body(box({1, 1, 1}), {3, 3, 3}, 0.25, 9, constrain)),
        reference(body),
        x(noisy(body.X, wavy, 0.02)),
        s(system_of(discretize(method, body), material)),
        state(reference_state(s)),
        forces(s) {
    // The wall's point lies where the particle's image in the face is half reached.
    walls.resize(body.cells.boundary.size());
    for (std::size_t a = 0; a < x.size(); ++a)
      for (const auto& n : reference.near[a])
        if (n.ghost) walls[n.face] = wavy(body.X[a] + 0.5 * n.X);
    for (std::size_t a = 0; a < x.size(); ++a) state.x[a] = to_kernel(x[a]);
    std::vector<Vec3> node_walls;
    for (const BoundaryNode& f : s.d.nodes) node_walls.push_back(walls[static_cast<std::size_t>(f.site)]);
    forces.evaluate(state, {node_walls, {}, {}}, 0.0);
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;
};

class GhostForces : public testing::TestWithParam<Conditions> {
 protected:
  static void expect_same_forces(Method method, const std::vector<Vec3>& internal, const Setting& t,
                                 const GhostReferenceForces& reference) {
    EXPECT_LT(relative_difference(internal, to_vectors(t.forces.internal(t.state).force)), 1e-12) << name_of(method);
    std::vector<Vec3> total = reference.contact_force();
    for (std::size_t a = 0; a < total.size(); ++a) total[a] += internal[a];
    EXPECT_LT(relative_difference(total, to_vectors(t.forces.total())), 1e-12) << name_of(method);
  }
};

/// F of [V 6] over real neighbours and ghosts, whose positions come from [V 15-24].
TEST_P(GhostForces, DeformationGradientsAreThoseOfThePaper) {
  const Setting t(Method::variational, GetParam().constrain);
  const GhostReferenceForces reference(t.reference, t.material, t.x, t.walls);
  for (std::size_t a = 0; a < t.x.size(); ++a)
    EXPECT_LT(size_of(to_mat3(t.forces.deformation_gradient()[a]) - reference.F[a]), 1e-12) << a;
}

/// [V 43] and the contact force [V 46].
TEST_P(GhostForces, VariationalForcesAreThoseOfThePaper) {
  const Setting t(Method::variational, GetParam().constrain);
  const GhostReferenceForces reference(t.reference, t.material, t.x, t.walls);
  expect_same_forces(Method::variational, reference.variational_internal_force(), t, reference);
}

/// [V 42] with reactions, and the contact force [V 46].
TEST_P(GhostForces, QuasiStaticForcesAreThoseOfThePaper) {
  const Setting t(Method::quasi_static, GetParam().constrain);
  const GhostReferenceForces reference(t.reference, t.material, t.x, t.walls);
  expect_same_forces(Method::quasi_static, reference.quasi_static_internal_force(), t, reference);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, GhostForces,
                         testing::Values(Conditions{"free", nothing}, Conditions{"mixed", mixed},
                                         Conditions{"held", everything}),
                         [](const auto& param) { return param.param.name; });

/// M'' of [V 70] is the derivative of F_a X_ab with respect to a particle: differences of the reference's own F, which
/// is linear in the positions.
TEST(GhostReferenceTensors, DerivativesOfAffineImagesAreM) {
  const VoronoiBody body = voronoi_body(box({1, 1, 1}), {3, 3, 3}, 0.25, 9, mixed);
  const GhostReference r(body);
  const std::vector<Vec3> walls(body.cells.boundary.size());
  for (std::size_t a : {0U, 4U, 13U})
    for (std::size_t c = 0; c < body.X.size(); ++c)
      for (int i = 0; i < 3; ++i) {
        std::vector<Vec3> x(body.X.size());
        x[c][i] = 1.0;
        const Mat3 F = r.deformation_gradient(a, r.branches(a, x, walls));
        for (std::size_t b = 0; b < r.near[a].size(); ++b) {
          const Mat3 M = r.M_double_prime(a, b, c);
          EXPECT_LT(norm(F * r.near[a][b].X - Vec3{M(0, i), M(1, i), M(2, i)}), 1e-12);
        }
      }
}

}  // namespace
}  // namespace tessera::test
