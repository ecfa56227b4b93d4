#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

#include "tessera/bench/cantilever.hpp"
#include "tessera/output/field_vtkhdf.hpp"
#include "tessera/simulation/engine.hpp"

namespace tessera::benchmarks {

constexpr int steps = 50;  // so that the numbers are as irregular as those of a run

/// The cantilever on its way.
struct MovingBeam {
  explicit MovingBeam(int per_metre) : spec(cantilever_case(Formulation::voronoi, per_metre)) {
    engine.prepare();
    for (int i = 0; i < steps; ++i) {
      engine.advance();
      engine.prepare();
    }
  }

  Case spec;
  Model model = build_model(spec);
  Engine engine{model, spec.time};
};

std::vector<const Quantity*> all_quantities() {
  std::vector<const Quantity*> all;
  for (const Quantity& quantity : quantity_table()) all.push_back(&quantity);
  return all;
}

/// All quantities computed and compressed, as a run does it before it goes on. An item is a particle.
void take_frame(benchmark::State& state) {
  const MovingBeam beam(static_cast<int>(state.range(0)));
  const Snapshot snapshot = beam.engine.snapshot();
  const std::vector<const Quantity*> quantities = all_quantities();
  VtkhdfFrames frames(quantities, FieldPrecision::mixed);
  for (auto _ : state) benchmark::DoNotOptimize(frames.take(parts_of(snapshot)));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(snapshot.position.size()));
}
BENCHMARK(take_frame)->ArgName("per_metre")->Arg(4)->Arg(16)->Unit(benchmark::kMillisecond);

/// The same frame into a file, as a run does it in the background. An item is a particle.
void write_frame(benchmark::State& state) {
  const MovingBeam beam(static_cast<int>(state.range(0)));
  const Snapshot snapshot = beam.engine.snapshot();
  const std::vector<const Quantity*> quantities = all_quantities();
  const VtkhdfFrame frame = VtkhdfFrames(quantities, FieldPrecision::mixed).take(parts_of(snapshot));
  const auto file = std::filesystem::temp_directory_path() / ("tessera_benchmark_" + std::to_string(getpid()) + ".hdf");
  for (auto _ : state) write_field_vtkhdf(file.string(), frame);
  std::filesystem::remove(file);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(snapshot.position.size()));
}
BENCHMARK(write_frame)->ArgName("per_metre")->Arg(4)->Arg(16)->Unit(benchmark::kMillisecond);

}  // namespace tessera::benchmarks
