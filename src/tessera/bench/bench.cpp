#include "tessera/bench/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "tessera/base/memory.hpp"
#include "tessera/bench/layout.hpp"
#include "tessera/bench/memory.hpp"
#include "tessera/bench/rubber.hpp"
#include "tessera/bench/triad.hpp"
#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/delaunay.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/dynamics/leapfrog.hpp"
#include "tessera/mechanics/cell_sweeps.hpp"
#include "tessera/mechanics/curved_sweep.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/parallel/workspaces.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

namespace {

constexpr Index sizes[] = {10'000, 100'000, 1'000'000};
constexpr int batches = 5;
constexpr double shortest_batch = 0.2;  // [s]

// What a body takes at the peak of its set-up, relative to what stays of it: measured 2.1 (setup_peak_bytes), and some
// to spare.
constexpr double peak_over_resident = 2.5;
constexpr Index sample_size = 10'000;  // of a body that tells what a particle takes

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Median time of one call, from batches that are long enough for the clock.
double seconds_per_call(const std::function<void()>& work) {
  const double first = seconds(work);
  const int calls = std::max(1, static_cast<int>(std::ceil(shortest_batch / std::max(first, 1e-9))));
  std::vector<double> times;
  for (int b = 0; b < batches; ++b)
    times.push_back(seconds([&] {
                      for (int i = 0; i < calls; ++i) work();
                    }) /
                    calls);
  return median(times);
}

Moments moments_for(Integration integration) {
  if (integration == Integration::nodal) return Moments::first;
  return integration == Integration::cell ? Moments::second_of_cells : Moments::second_of_faces;
}

/// A unit cube with about `particles` particles.
System build(Index particles, const MethodSpec& method, std::map<std::string, double>& stages) {
  Shape shape;
  shape.kind = BoxShape{{0, 0, 0}, {1, 1, 1}};
  const Solid solid = build_solid(shape);
  const int n = static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles))));
  LatticeSpec lattice;
  lattice.counts = std::array<int, 3>{n, n, n};
  lattice.jitter = 0.25;
  const bool delaunay = method.formulation == Formulation::delaunay, by_cells = method.integration == Integration::cell;
  const bool curved = method.integration == Integration::second_order;

  PointSet points;
  std::vector<Vec3> X;
  stages["points"] = seconds([&] {
    points = place_particles({lattice, {}}, solid, delaunay ? Placement::vertices : Placement::cell_centres);
    X = permuted(points.points, hilbert_order(points.points));
  });
  Discretization d;
  if (delaunay) {
    TetrahedralMesh mesh;
    stages["cells"] = seconds([&] { mesh = tetrahedralize(points, solid, Tetrahedralization::automatic); });
    stages["bonds"] = seconds([&] {
      d = discretize_delaunay(mesh, {});
      if (by_cells) d.measure = measure_of_dual_cells(mesh);
    });
  } else {
    Cells cells;
    stages["cells"] = seconds([&] { cells = voronoi_cells(X, solid, moments_for(method.integration)); });
    const std::vector<Mat3> D(cells.boundary.size());
    stages["bonds"] = seconds([&] {
      d = discretize_consistent(X, cells, D, curved ? FaceOrder::quadratic : FaceOrder::linear);
      if (by_cells) d.measure = measure_of_cells(cells);
    });
  }
  System system;
  stages["system"] = seconds([&] {
    const std::vector<Index> material(d.X.size(), 0);
    system = make_system(std::move(d), {bench_rubber()}, material);
  });
  return system;
}

/// Time that threads spend in the sweeps of a pass over the tiles.
struct PassSeconds {
  double contact = 0.0, stress = 0.0, force = 0.0;

  PassSeconds& operator+=(const PassSeconds& o) {
    contact += o.contact, stress += o.stress, force += o.force;
    return *this;
  }
};

void second_order_stress(const System& s, Index tile, const Tensor* F, TileScratch& scratch,
                         SecondOrderMemory& memory) {
  const Tile& t = s.tiles.tiles[static_cast<std::size_t>(tile)];
  curved_stress_sweep(s, tile, F, {}, nullptr, 0.0, scratch, memory, {});
  for (Index a = t.begin; a < t.end; ++a)
    memory.T[static_cast<std::size_t>(a)] = to_tensor(scratch.T[static_cast<std::size_t>(a - t.begin)]);
}

/// The sweeps one by one, on arrays of their own. Those of the second pass follow each other tile by tile as in a step,
/// because each finds in the cache what went before; their times are taken within the tile.
void measure_sweeps(const System& s, std::map<std::string, double>& stages) {
  const State state = reference_state(s);
  const auto n = static_cast<std::size_t>(s.particles());
  Field<Tensor> F(n);
  Field<Double4> f(n), rim_f(s.tiles.rim.size());
  RawField<Tensor> own(s.gradients ? n : 0), rims(s.gradients ? s.tiles.rim.size() : 0);
  SecondOrderMemory curved(s);
  parallel::Workspaces<TileScratch> scratches([&] { return std::make_unique<TileScratch>(s); });
  using Lease = parallel::Workspaces<TileScratch>::Lease;
  stages["strain"] = seconds_per_call([&] {
    if (s.second_order) return find_strain(s, state.x.data(), curved, F.data());
    parallel::for_tasks(s.tiles.size(), [&](std::int64_t tile) {
      const Lease scratch(scratches);
      strain_sweep(s, static_cast<Index>(tile), state.x.data(), F.data(), *scratch);
    });
  });
  const auto second_pass = [&](std::int64_t task) {
    const Lease scratch(scratches);
    const auto tile = static_cast<Index>(task);
    PassSeconds spent;
    spent.contact = seconds([&] { contact_sweep(s, tile, state.x.data(), F.data(), f.data(), *scratch); });
    spent.stress = seconds([&] {
      if (s.second_order)
        second_order_stress(s, tile, F.data(), *scratch, curved);
      else if (s.gradients)
        cell_stress_sweep(s, tile, F.data(), {}, nullptr, 0.0, *scratch, {own.data(), rims.data()}, {});
      else
        stress_sweep(s, tile, F.data(), {}, nullptr, 0.0, *scratch);
    });
    if (s.second_order) return spent;  // whose forces come in another pass
    spent.force = seconds(
        [&] { force_sweep(s, tile, scratch->T.data(), s.tiles.B.data(), s.d.B_aa.data(), f.data(), rim_f.data()); });
    return spent;
  };
  std::vector<double> contact, stress, force;
  const double pass = seconds_per_call([&] {
    const auto spent = parallel::sum_tasks<PassSeconds>(s.tiles.size(), second_pass);
    contact.push_back(spent.contact), stress.push_back(spent.stress), force.push_back(spent.force);
  });
  const PassSeconds each{median(contact), median(stress), median(force)};
  const double share = pass / (each.contact + each.stress + each.force);  // of all threads' time
  stages["contact"] = share * each.contact;
  stages["stress"] = share * each.stress;
  stages["force"] = share * each.force;
  if (s.second_order)
    stages["force"] = seconds_per_call([&] {
      parallel::for_tasks(s.tiles.size(), [&](std::int64_t tile) {
        add_forces(s, static_cast<Index>(tile), curved, f.data(), rim_f.data());
      });
    });
  stages["rims"] = seconds_per_call([&] {
    parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
      collect_rims(s.tiles, rim_f.data(), f.data() + begin, f.data() + begin, static_cast<Index>(begin),
                   static_cast<Index>(end));
    });
  });
}

/// Whole steps and, of them, kick and drift.
double measure_step(const System& s, std::map<std::string, double>& stages) {
  Loads loads;
  State state = reference_state(s);
  Forces forces(s);
  const Leapfrog leapfrog(s, loads, 0.0);
  const double dt = 1e-9;  // the body stays near rest; the work does not depend on the motion
  forces.evaluate(state, {{}, {}, {}}, dt);
  stages["kick"] = seconds_per_call([&] { leapfrog.step(state, forces, {dt, dt}); });
  return seconds_per_call([&] {
    forces.evaluate(state, {{}, {}, {}}, dt);
    leapfrog.step(state, forces, {dt, dt});
  });
}

BenchRow measure(Index particles, int threads, const MethodSpec& method) {
  parallel::set_threads(threads);
  BenchRow row;
  row.threads = threads;
  row.formulation = method.formulation == Formulation::delaunay ? "delaunay" : "voronoi";
  row.integration = name_of(method.integration);
  const PeakMemory memory;
  const System system = build(particles, method, row.stages);
  if (const auto peak = memory.bytes()) row.setup_peak_bytes = *peak / static_cast<double>(system.particles());
  for (const auto& [name, time] : row.stages) row.setup_seconds += time;
  row.particles = system.particles();
  row.bytes_per_particle_step = bytes_per_particle_step(system);
  row.bytes_per_particle = bytes_per_particle(system);
  measure_sweeps(system, row.stages);
  row.stages["step"] = measure_step(system, row.stages);
  row.particle_steps_per_second = static_cast<double>(row.particles) / row.stages["step"];
  return row;
}

std::vector<int> thread_counts(const BenchOptions& options) {
  if (options.threads) return {*options.threads};
  std::vector<int> counts;
  for (int t = 1; t <= parallel::threads(); ++t) counts.push_back(t);
  return counts;
}

/// Throws UsageError when so many particles do not fit into the memory that is left.
void require_memory(Index particles, const MethodSpec& method) {
  const std::optional<double> available = available_memory();
  if (particles <= 10 * sample_size || !available) return;
  std::map<std::string, double> stages;
  const double needed = peak_over_resident * particles * bytes_per_particle(build(sample_size, method, stages));
  if (needed > *available)
    throw UsageError(
        fmt::format("{} particles need about {:.1f} GB while they are set up and {:.1f} GB are available; "
                    "give fewer with --particles",
                    particles, 1e-9 * needed, 1e-9 * *available));
}

void measure_speed(const BenchOptions& options, BenchReport& report) {
  const std::vector<int> threads = thread_counts(options);
  MethodSpec method;
  method.formulation = options.formulation.value_or(Formulation::voronoi);
  method.integration = options.integration.value_or(Integration::nodal);
  std::vector<Index> particles(std::begin(sizes), std::end(sizes));
  if (options.particles) particles = {*options.particles};
  require_memory(particles.back(), method);
  for (int t : threads) {
    fmt::print(stderr, "bench: triad, {} thread{}\n", t, t == 1 ? "" : "s");
    parallel::set_threads(t);
    report.triad_bytes_per_second[t] = triad_bandwidth();
  }
  for (Index n : particles)
    for (int t : threads) {
      fmt::print(stderr, "bench: {} particles, {} thread{}\n", n, t, t == 1 ? "" : "s");
      report.rows.push_back(measure(n, t, method));
    }
}

void measure_accuracy(const BenchOptions& options, int threads, BenchReport& report) {
  parallel::set_threads(options.threads.value_or(threads));
  for (const MethodSpec& method : methods_of_accuracy(options))
    report.accuracy.push_back(measure_accuracy(method.formulation, method.integration));
}

}  // namespace

std::vector<MethodSpec> methods_of_accuracy(const BenchOptions& options) {
  std::vector<MethodSpec> methods;
  for (const Formulation formulation : {Formulation::delaunay, Formulation::voronoi})
    for (const Integration integration : {Integration::nodal, Integration::cell, Integration::second_order}) {
      const bool wanted = options.formulation.value_or(formulation) == formulation &&
                          options.integration.value_or(integration) == integration;
      const bool known = formulation == Formulation::voronoi || integration != Integration::second_order;
      if (wanted && known) methods.emplace_back().formulation = formulation, methods.back().integration = integration;
    }
  return methods;
}

BenchReport run_bench(const BenchOptions& options) {
  BenchReport report;
  const int all_threads = parallel::threads();
  if (options.parts != BenchParts::accuracy) measure_speed(options, report);
  if (options.parts != BenchParts::speed) measure_accuracy(options, all_threads, report);
  return report;
}

}  // namespace tessera
