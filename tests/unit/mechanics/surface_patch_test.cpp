#include <gtest/gtest.h>

#include "support/balance.hpp"
#include "support/triangle_surfaces.hpp"
#include "tessera/discretization/identities.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera::test {
namespace {

struct Body {
  std::string name;
  TriangleSurface surface;
  double spacing;
};

/// The last two have cells in several parts, some of which neighbours take over.
std::vector<Body> bodies() {
  return {{"ball", ball_surface(1.0, 12, 24), 0.35},
          {"torus", torus_surface(1.0, 0.4, 24, 10), 0.25},
          {"plate", turned(box_surface({0, 0, 0}, {2, 1.5, 0.5}), 1.1), 0.2},
          {"gear", turned(gear_surface(18, 0.4, 1.0, 1.3, 0.5), 0.7), 0.2},
          {"spikes", spiky_surface(1, 20, 40, 0.3), 0.2}};
}

struct Built {
  std::vector<Vec3> X;
  SurfaceCells made;
  double volume = 0.0;
};

Built build(const Body& body, unsigned seed) {
  const SurfaceIndex index(body.surface);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-0.3, 0.3);
  const Bounds box = bounds(body.surface);
  Built built;
  const double h = body.spacing;
  for (double x = box.lower.x + 0.5 * h; x < box.upper.x; x += h)
    for (double y = box.lower.y + 0.5 * h; y < box.upper.y; y += h)
      for (double z = box.lower.z + 0.5 * h; z < box.upper.z; z += h) {
        const Vec3 X = Vec3{x, y, z} + h * Vec3{move(random), move(random), move(random)};
        if (index.location(X) == Location::inside && index.nearest(X).distance > 0.1 * h) built.X.push_back(X);
      }
  built.made = surface_cells(built.X, index);
  built.volume = volume(body.surface);
  return built;
}

class SurfacePatchTest : public testing::TestWithParam<unsigned> {};

TEST_P(SurfacePatchTest, IdentitiesHold) {
  for (const Body& body : bodies()) {
    const Built built = build(body, GetParam());
    EXPECT_TRUE(built.made.adopted > 0 || body.name != "spikes");
    for (const Mat3& D : {Mat3{}, identity()}) {
      const std::vector<Mat3> all(built.made.cells.boundary.size(), D);
      const Discretization d = discretize_consistent(built.X, built.made.cells, all);
      for (const auto& [name, value] : identities_of_voronoi(d, built.made.cells, built.volume))
        EXPECT_LT(value, 1e-11) << body.name << ": " << name;
    }
  }
}

/// Test A: linear motion everywhere; F is exact and the forces balance.
TEST_P(SurfacePatchTest, LinearMotionIsExactAndInEquilibrium) {
  for (const Body& body : bodies()) {
    const Built built = build(body, GetParam());
    const std::vector<Mat3> D(built.made.cells.boundary.size(), identity());
    const System s = system_of(discretize_consistent(built.X, built.made.cells, D), rubber());
    const std::vector<Vec3> walls = walls_of(s, linear);
    State state = reference_state(s);
    move(state, s, linear);
    Forces forces(s);
    forces.evaluate(state, {walls, {}, {}}, 0.0);
    for (const Tensor& F : forces.deformation_gradient()) {
      const Mat3 error = to_mat3(F) - identity() - patch_gradient;
      EXPECT_LT(std::sqrt(contract(error, error)), 1e-13) << body.name;
    }
    EXPECT_LT(largest(forces.total()), 1e-9 * largest(forces.reactions())) << body.name;
  }
}

/// Test C at the exact solution: the traction P N on free faces balances a constant stress.
TEST_P(SurfacePatchTest, TractionsBalanceConstantStress) {
  for (const Body& body : bodies()) {
    const Built built = build(body, GetParam());
    const std::vector<Mat3> D(built.made.cells.boundary.size());
    const System s = system_of(discretize_consistent(built.X, built.made.cells, D), rubber());
    State state = reference_state(s);
    move(state, s, linear);
    const std::vector<NodalForce> loads = loads_of_stress(s, patch_stress());
    Forces forces(s);
    forces.evaluate(state, {{}, loads, {}}, 0.0);
    EXPECT_LT(largest(forces.total()), 1e-9 * largest(loads)) << body.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SurfacePatchTest, testing::Values(1U, 2U, 3U));

}  // namespace
}  // namespace tessera::test
