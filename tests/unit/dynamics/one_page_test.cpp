#include "docs/one_page.cpp"

#include <gtest/gtest.h>

#include "support/small_bodies.hpp"
#include "tessera/dynamics/leapfrog.hpp"

namespace tessera::test {
namespace {

/// docs/one_page.cpp, written from the paper's sums, and the library move a body alike.
TEST(OnePage, MovesAsTheLibraryDoes) {
  const PointSet points = lattice(box({1, 1, 1}), {4, 4, 4}, 0.25, 3, Placement::vertices);
  const TetrahedralMesh mesh = tetrahedralize(points, box({1, 1, 1}), Tetrahedralization::split);
  const Material m = rubber();
  const NeoHookean law = std::get<NeoHookean>(m.law);
  const System s = system_of(discretize_delaunay(mesh, {}), m);

  std::vector<std::array<int, 4>> tetrahedra(mesh.tetrahedra.begin(), mesh.tetrahedra.end());
  one_page::Body body = one_page::make_body(mesh.points, tetrahedra);
  State state = reference_state(s);
  for (std::size_t a = 0; a < body.X.size(); ++a) {
    body.v[a] = {3.0 * body.X[a].y, 0.0, -2.0 * body.X[a].x};
    state.v[a] = to_kernel(body.v[a]);
  }
  const double dt = 1e-3;
  const int steps = 50;
  one_page::run(body, law, m.young, m.density, dt, steps);

  Loads loads;
  Forces forces(s);
  Leapfrog leapfrog(s, loads, 0.0);
  forces.evaluate(state, {{}, {}, {}}, 0.0);
  leapfrog.start(state, forces, dt);
  for (int i = 0; i < steps; ++i) {
    leapfrog.step(state, forces, {dt, dt});
    forces.evaluate(state, {{}, {}, {}}, dt);
  }
  for (std::size_t a = 0; a < body.X.size(); ++a) {
    EXPECT_LT(norm(to_vec3(state.x[a]) - body.x[a]), 1e-12);
    EXPECT_GT(norm(body.x[a] - body.X[a]), 1e-4);
  }
}

}  // namespace
}  // namespace tessera::test
