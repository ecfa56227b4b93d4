#include <benchmark/benchmark.h>

#include "cube.hpp"
#include "tessera/mechanics/state.hpp"
#include "tessera/mechanics/sweeps.hpp"

namespace tessera::benchmarks {

/// A free cube of Voronoi particles, a little deformed, and what the sweeps write.
struct SweptCube {
  explicit SweptCube(std::int64_t particles) : system(cube_system(particles)), scratch(system) {
    state = reference_state(system);
    test::move(state, system, [](const Vec3& X) { return X + 0.05 * (test::wavy(X) - X); });
    F.resize(static_cast<std::size_t>(system.particles()));
    f.resize(F.size());
    rim_f.resize(system.tiles.rim.size());
    for (Index tile = 0; tile < system.tiles.size(); ++tile) strain(tile);
  }

  static System cube_system(std::int64_t particles) {
    const Solid cube = test::box({1, 1, 1});
    const std::vector<Vec3> X = cube_points(cube, particles);
    const Cells cells = voronoi_cells(X, cube);
    const std::vector<Mat3> D(cells.boundary.size());
    return test::system_of(discretize_consistent(X, cells, D), test::rubber(), 0);
  }

  void strain(Index tile) { strain_sweep(system, tile, state.x.data(), F.data(), scratch); }

  void contact_stress_force(Index tile) {
    contact_sweep(system, tile, state.x.data(), F.data(), f.data(), scratch);
    stress_sweep(system, tile, F.data(), {}, nullptr, 0.0, scratch);
    force_sweep(system, tile, scratch.T.data(), system.tiles.B.data(), system.d.B_aa.data(), f.data(), rim_f.data());
  }

  System system;
  State state;
  TileScratch scratch;
  Field<Tensor> F;
  Field<Double4> f, rim_f;
};

/// An item is a particle.
void sweep(benchmark::State& state, void (SweptCube::*work)(Index)) {
  SweptCube cube(state.range(0));
  for (auto _ : state)
    for (Index tile = 0; tile < cube.system.tiles.size(); ++tile) (cube.*work)(tile);
  state.SetItemsProcessed(state.iterations() * cube.system.particles());
}

void sweep_strain(benchmark::State& state) { sweep(state, &SweptCube::strain); }
void sweep_contact_stress_force(benchmark::State& state) { sweep(state, &SweptCube::contact_stress_force); }

BENCHMARK(sweep_strain)->ArgName("particles")->RangeMultiplier(10)->Range(1000, 100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(sweep_contact_stress_force)
    ->ArgName("particles")
    ->RangeMultiplier(10)
    ->Range(1000, 100'000)
    ->Unit(benchmark::kMillisecond);

}  // namespace tessera::benchmarks
