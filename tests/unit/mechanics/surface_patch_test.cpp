#include <gtest/gtest.h>

#include "support/small_bodies.hpp"
#include "support/triangle_surfaces.hpp"
#include "tessera/discretization/identities.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera::test {
namespace {

const Mat3 gradient{{1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4, 7e-4, 8e-4, 9e-4}};  // [V 52]

Vec3 linear(const Vec3& X) { return X + gradient * X; }

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

/// Largest force on a particle [N].
double largest(const Forces& forces) {
  double f = 0.0;
  for (const Double4& total : forces.total()) f = std::max(f, norm(to_vec3(total)));
  return f;
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
      const Mat3 error = to_mat3(F) - identity() - gradient;
      EXPECT_LT(std::sqrt(contract(error, error)), 1e-13) << body.name;
    }
    double reaction = 0.0;
    for (const Vec3& r : forces.reactions()) reaction = std::max(reaction, norm(r));
    EXPECT_LT(largest(forces), 1e-9 * reaction) << body.name;
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
    const Mat3 P = std::get<NeoHookean>(rubber().law).stress(identity() + gradient);
    std::vector<NodalForce> loads;
    double load = 0.0;
    for (std::size_t i = 0; i < s.d.sites.size(); ++i)
      for (const LoadShare& share : s.d.load.row(static_cast<Index>(i))) {
        loads.push_back({share.particle, share.area * (P * s.d.sites[i].N)});
        load = std::max(load, norm(loads.back().force));
      }
    Forces forces(s);
    forces.evaluate(state, {{}, loads, {}}, 0.0);
    EXPECT_LT(largest(forces), 1e-9 * load) << body.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SurfacePatchTest, testing::Values(1U, 2U, 3U));

}  // namespace
}  // namespace tessera::test
