// Takes the given number of steps with a small body, for counting instructions: what one step more costs is the
// difference of two runs. Usage: step_program voronoi|delaunay STEPS; prints the number of particles.

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/small_bodies.hpp"
#include "tessera/dynamics/leapfrog.hpp"
#include "tessera/parallel/parallel.hpp"

int main(int count, char** arguments) {
  using namespace tessera;
  if (count != 3) return 2;
  parallel::set_threads(1);
  const bool delaunay = std::strcmp(arguments[1], "delaunay") == 0;
  const long steps = std::strtol(arguments[2], nullptr, 10);
  const test::Method method = delaunay ? test::Method::delaunay : test::Method::consistent;
  const System s = test::system_of(test::discretize(method, test::box({1, 1, 1}), {12, 12, 12}, 0.25, 1, test::nothing),
                                   test::rubber(), 0);
  State state = reference_state(s);
  for (std::size_t a = 0; a < s.d.X.size(); ++a) state.v[a] = to_kernel(Vec3{s.d.X[a].y, -s.d.X[a].x, s.d.X[a].x});
  Forces forces(s);
  const Loads loads;
  const Leapfrog leapfrog(s, loads, 0.0);
  constexpr double dt = 1e-4;
  for (long i = 0; i < steps; ++i) {
    forces.evaluate(state, {{}, {}, {}}, dt);
    leapfrog.step(state, forces, {dt, dt});
  }
  std::printf("%d\n", s.particles());
  return forces.sums().finite ? 0 : 1;
}
