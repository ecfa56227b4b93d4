#include <gtest/gtest.h>

#include "support/consistent_reference.hpp"

namespace tessera::test {
namespace {

struct Body {
  std::string name;
  VoronoiBody body;
};

/// Conditions of all kinds on the sides of the L-block, the re-entrant ones included.
Mat3 mixed_on_l_block(const Vec3& C, const Vec3& N) {
  if (C.x < 1e-9) return outer(N, N);
  if (C.y < 1e-9) return identity() - outer(N, N);
  if (std::abs(C.y - 3.0) < 1e-9 && N.y > 0.5) return diagonal(1, 0, 1);
  if (C.z < 1e-9) return identity();
  return {};
}

std::vector<Body> bodies() {
  std::vector<Body> all;
  for (const auto& [name, constrain] :
       std::vector<std::pair<std::string, Constrain>>{{"free", nothing}, {"mixed", mixed}, {"held", everything}})
    all.push_back({"box " + name, voronoi_body(box({1, 1, 1}), {3, 3, 3}, 0.25, 9, constrain)});
  all.push_back({"L-block", voronoi_body(l_block(), {4, 6, 2}, 0.3, 4, mixed_on_l_block)});
  return all;
}

/// F from face positions, forces and reactions term by term: all against the library.
class ConsistentForces : public testing::TestWithParam<Integration> {};

TEST_P(ConsistentForces, AreThoseOfTheFacesPositions) {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  for (const Body& b : bodies()) {
    SCOPED_TRACE(b.name);
    const ConsistentReference reference(b.body);
    const double scale = std::cbrt(b.body.cells.volume[0]);
    const auto motion = [](const Vec3& X) { return wavy((1.0 / 6.0) * X) * 6.0; };
    const std::vector<Vec3> x = noisy(b.body.X, motion, 0.05 * scale);
    std::vector<Vec3> walls;
    for (const BoundaryFace& f : b.body.cells.boundary) walls.push_back(motion(f.centroid));
    const ConsistentReferenceForces expected(reference, b.body, m, x, walls, GetParam());

    const System s = system_of(discretize(Method::consistent, b.body, GetParam()), m);
    State state = reference_state(s);
    for (std::size_t a = 0; a < x.size(); ++a) state.x[a] = to_kernel(x[a]);
    std::vector<Vec3> node_walls, wall_forces;
    for (const BoundaryNode& f : s.d.nodes) {
      node_walls.push_back(walls[static_cast<std::size_t>(f.site)]);
      wall_forces.push_back(expected.walls[static_cast<std::size_t>(f.site)]);
    }
    Forces forces(s);
    forces.evaluate(state, {node_walls, {}, {}}, 0.0);
    for (std::size_t a = 0; a < x.size(); ++a)
      EXPECT_LT(size_of(to_mat3(forces.deformation_gradient()[a]) - expected.F[a]), 1e-12) << a;
    EXPECT_LT(relative_difference(expected.particles, to_vectors(forces.total())), 1e-12);
    if (node_walls.empty()) continue;
    EXPECT_LT(relative_difference(wall_forces, forces.reactions()), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Integrations, ConsistentForces, testing::Values(Integration::nodal, Integration::cell),
                         [](const auto& param) { return name_of(param.param); });

}  // namespace
}  // namespace tessera::test
