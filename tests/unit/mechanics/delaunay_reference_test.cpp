#include <gtest/gtest.h>

#include "support/delaunay_reference.hpp"
#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

/// Different normal and tangential stiffness, so that all terms of [D 57] count.
Material sample_material() {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  return m;
}

class DelaunayForces : public testing::Test {
 protected:
  TetrahedralMesh mesh = tetrahedra(box({1, 1, 1}), {3, 2, 3}, 0.2, 3);
  DelaunayReference reference{mesh};
  System s = system_of(discretize_delaunay(mesh, {}), sample_material());
  std::vector<Vec3> x = noisy(mesh.points, wavy, 0.02);
  State state = reference_state(s);
  Forces forces{s};

  void SetUp() override {
    for (std::size_t a = 0; a < x.size(); ++a) state.x[a] = to_kernel(x[a]);
    forces.evaluate(state, {{}, {}, {}}, 0.0);
  }
};

/// F of [D 28], which includes b = a.
TEST_F(DelaunayForces, DeformationGradientsAreThoseOfThePaper) {
  for (std::size_t a = 0; a < x.size(); ++a)
    EXPECT_LT(size_of(to_mat3(forces.deformation_gradient()[a]) - reference.deformation_gradient(x, a)), 1e-12);
}

/// [D 45]
TEST_F(DelaunayForces, InternalForceIsThatOfThePaper) {
  const std::vector<Vec3> internal = to_vectors(forces.internal(state).force);
  EXPECT_LT(relative_difference(reference.internal_force(x, sample_material()), internal), 1e-12);
}

/// The double sum [D 50] against bond forces and contact stress.
TEST_F(DelaunayForces, ContactForceIsThatOfThePaper) {
  std::vector<Vec3> contact = to_vectors(forces.total());
  const std::vector<Vec3> internal = to_vectors(forces.internal(state).force);
  for (std::size_t a = 0; a < x.size(); ++a) contact[a] -= internal[a];
  EXPECT_LT(relative_difference(reference.contact_force(x, sample_material()), contact), 1e-12);
}

}  // namespace
}  // namespace tessera::test
