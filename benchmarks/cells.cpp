#include <benchmark/benchmark.h>

#include "cube.hpp"
#include "tessera/discretization/face_positions.hpp"
#include "tessera/tessellation/voronoi_cutter.hpp"
#include "tessera/tessellation/voronoi_grid.hpp"

namespace tessera::benchmarks {

/// An item is a cell.
void cut_voronoi_cells(benchmark::State& state) {
  const Solid cube = test::box({1, 1, 1});
  const std::vector<Vec3> X = cube_points(cube, state.range(0));
  const PointGrid grid = VoronoiCutter::grid_of(X, cube);
  VoronoiCutter cutter(X, cube, grid);
  for (auto _ : state)
    for (Index a = 0; a < static_cast<Index>(X.size()); ++a) benchmark::DoNotOptimize(cutter.cut(a).data());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(X.size()));
}
BENCHMARK(cut_voronoi_cells)->ArgName("particles")->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

/// An item is a face, of the boundary or between two cells.
void find_face_positions(benchmark::State& state) {
  const Solid cube = test::box({1, 1, 1});
  const std::vector<Vec3> X = cube_points(cube, state.range(0));
  const Cells cells = voronoi_cells(X, cube);
  const Csr<FaceOfCell> faces = faces_of_cells(cells);
  const std::vector<Mat3> D(cells.boundary.size());
  for (auto _ : state) benchmark::DoNotOptimize(face_positions(X, cells, faces, D));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells.interior.size() + D.size()));
}
BENCHMARK(find_face_positions)->ArgName("particles")->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

}  // namespace tessera::benchmarks
