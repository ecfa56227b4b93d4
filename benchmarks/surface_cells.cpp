#include <benchmark/benchmark.h>

#include <array>
#include <numbers>
#include <string>

#include "support/surfaces.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/random.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera::benchmarks {
namespace {

enum Body : std::int64_t { ball, torus, scan };
enum Arrangement : std::int64_t { lattice, jittered, discs };

constexpr std::array body_names{"ball", "torus", "scan"};
constexpr std::array arrangement_names{"lattice", "jittered", "random"};

/// A ball with bumps and the roughness of a measurement.
TriangleSurface scanned(int rings, int sectors) {
  return test::star_surface(rings, sectors, [=](int i, int j) {
    const double theta = std::numbers::pi * i / rings, phi = 2.0 * std::numbers::pi * j / sectors;
    const auto counter = static_cast<std::uint64_t>(i) * static_cast<std::uint64_t>(sectors) +
                         (i == 0 || i == rings ? 0 : static_cast<std::uint64_t>(j));
    return 1.0 + 0.1 * std::sin(5.0 * theta) * std::sin(theta) * std::cos(7.0 * phi) + 1e-3 * random_number(1, counter);
  });
}

/// With about this number of triangles.
TriangleSurface surface_of(std::int64_t body, std::int64_t triangles) {
  const int n = static_cast<int>(std::sqrt(static_cast<double>(triangles) / 4.0));
  if (body == torus) return test::torus_surface(1.0, 0.4, 2 * n, n);
  return body == ball ? test::ball_surface(1.0, n, 2 * n) : scanned(n, 2 * n);
}

std::vector<Vec3> points_in(const SurfaceIndex& index, std::int64_t arrangement, Index count) {
  ParticleSpec spec;
  if (arrangement == discs) {
    spec.source = RandomSpec{{count, {}}, 1};
  } else {
    LatticeSpec cubic;
    cubic.count = count;
    cubic.jitter = arrangement == jittered ? 0.25 : 0.0;
    spec.source = cubic;
  }
  const std::vector<Vec3> X = place_particles(spec, index).points;
  return permuted(X, hilbert_order(X));
}

}  // namespace

/// Cells cut by a surface of about as many triangles. An item is a cell.
void cut_surface_cells(benchmark::State& state) {
  const TriangleSurface surface = surface_of(state.range(1), state.range(0));
  const SurfaceIndex index(surface);
  const std::vector<Vec3> X = points_in(index, state.range(2), static_cast<Index>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(surface_cells(X, index).cells.volume.data());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(X.size()));
  state.SetLabel(std::string(body_names[static_cast<std::size_t>(state.range(1))]) + ", " +
                 arrangement_names[static_cast<std::size_t>(state.range(2))]);
}
BENCHMARK(cut_surface_cells)
    ->ArgNames({"cells_and_triangles", "body", "arrangement"})
    ->ArgsProduct({{1000, 100'000}, {ball, torus, scan}, {lattice, jittered, discs}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace tessera::benchmarks
