#include "tessera/tessellation/relax.hpp"

#include "surface_helpers.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera::test {
namespace {

RelaxedSpec relaxed_of(Index count, int iterations, double tolerance, const std::string& size = "") {
  RelaxedSpec spec;
  spec.amount.count = count;
  spec.iterations = iterations;
  spec.tolerance = tolerance;
  if (!size.empty()) spec.size = Formula(size, somewhere());
  return spec;
}

Relaxed relaxed_in(const Solid& solid, const RelaxedSpec& spec) {
  return relax(points_of({spec, somewhere()}, solid), solid, spec, 3);
}

/// Standard deviation of values divided by their mean.
double scatter(const std::vector<double>& values) {
  double sum = 0.0, square = 0.0;
  for (const double v : values) sum += v, square += v * v;
  const double mean = sum / static_cast<double>(values.size());
  return std::sqrt(square / static_cast<double>(values.size()) - mean * mean) / mean;
}

/// The centroids are those of the cells that voronoi_cells makes, so a relaxed set is centroidal by its measure too.
TEST(Relax, ParticlesComeToTheCentroidsOfTheirCells) {
  const Solid block = build_solid(l_polygon());
  const Relaxed relaxed = relaxed_in(block, relaxed_of(400, 200, 2e-3));
  EXPECT_LE(relaxed.distance, 2e-3);
  EXPECT_LT(relaxed.iterations, 200);
  const Cells cells = voronoi_cells(relaxed.points, block);
  double sum = 0.0;
  for (std::size_t a = 0; a < relaxed.points.size(); ++a)
    sum += norm2(cells.centroid[a] - relaxed.points[a]) / std::pow(cells.volume[a], 2.0 / 3);
  EXPECT_LE(std::sqrt(sum / 400), 4e-3);
  EXPECT_LT(scatter(cells.volume), 0.06);
}

/// In one dimension there is one answer: cells of equal lengths.
TEST(Relax, ARowOfParticlesBecomesALattice) {
  const Solid rod = build_solid(box({0, 0, 0}, {10, 0.1, 0.1}));
  std::vector<Vec3> points;
  for (int i = 0; i < 10; ++i) points.push_back({0.2 + 0.9 * i + 0.05 * (i % 3), 0.03, 0.06});
  const Relaxed relaxed = relax(points, rod, relaxed_of(10, 1000, 1e-9), 3);
  for (int i = 0; i < 10; ++i)
    EXPECT_LT(norm(relaxed.points[static_cast<std::size_t>(i)] - Vec3{i + 0.5, 0.05, 0.05}), 1e-6);
}

/// Cells whose sizes range over a factor of four follow the formula.
TEST(Relax, CellsBecomeAsLargeAsTheSizeSays) {
  const Solid cube = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const Relaxed relaxed = relaxed_in(cube, relaxed_of(1500, 60, 0.0, "0.05 + 0.15*X*X"));
  const Cells cells = voronoi_cells(relaxed.points, cube);
  std::vector<double> ratio;
  for (std::size_t a = 0; a < relaxed.points.size(); ++a)
    ratio.push_back(std::cbrt(cells.volume[a]) / (0.05 + 0.15 * relaxed.points[a].x * relaxed.points[a].x));
  EXPECT_LT(scatter(ratio), 0.06);
  const auto [least, most] = std::minmax_element(cells.volume.begin(), cells.volume.end());
  EXPECT_GT(*most / *least, 25.0);
}

TEST(Relax, FillsWhatASurfaceEncloses) {
  for (const TriangleSurface& surface : {ball_surface(1.0, 12, 24), gear_surface(9, 0.4, 0.8, 1.0, 0.5)}) {
    const SurfaceIndex index(surface);
    const RelaxedSpec spec = relaxed_of(300, 40, 0.0);
    const Relaxed relaxed = relax(place_particles({spec, somewhere()}, index).points, index, spec);
    for (const Vec3& X : relaxed.points) EXPECT_EQ(index.location(X), Location::inside);
    const SurfaceCells made = surface_cells(relaxed.points, index);
    expect_exact(made, relaxed.points, surface, "relaxed");
    EXPECT_LT(scatter(made.cells.volume), 0.1);
    EXPECT_LT(relaxed.distance, 0.01);
  }
}

/// A box is the same solid as its surface: cells that the surface does not cut are taken from the other cutter.
TEST(Relax, GoesTheSameWayInASurfaceAsInASolid) {
  const Solid cube = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const TriangleSurface surface = box_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceIndex index(surface);
  const RelaxedSpec spec = relaxed_of(200, 5, 0.0);
  const std::vector<Vec3> start = points_of({spec, somewhere()}, cube);
  const Relaxed one = relax(start, cube, spec, 3), two = relax(start, index, spec);
  for (std::size_t a = 0; a < start.size(); ++a) EXPECT_LT(norm(one.points[a] - two.points[a]), 1e-12);
}

TEST(Relax, StaysInThePlane) {
  const Solid slab = build_solid(box({0, 0, 0}, {2, 1, 1}));
  const RelaxedSpec spec = relaxed_of(200, 100, 5e-3);
  ParticleSpec particles{spec, somewhere()};
  particles.dimension = 2;
  const Relaxed relaxed = relax(points_of(particles, slab), slab, spec, 2);
  for (const Vec3& X : relaxed.points) EXPECT_EQ(X.z, 0.5);
  EXPECT_LE(relaxed.distance, 5e-3);
  EXPECT_LT(scatter(voronoi_cells(relaxed.points, slab).volume), 0.08);
}

TEST(Relax, HasTheSameBitsForAnyNumberOfThreads) {
  const int before = parallel::threads();
  const Solid cube = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const auto points = [&](int threads) {
    parallel::set_threads(threads);
    return relaxed_in(cube, relaxed_of(2500, 4, 0.0, "1 + X + Y*Y")).points;
  };
  EXPECT_EQ(points(1), points(3));
  parallel::set_threads(before);
}

}  // namespace
}  // namespace tessera::test
