#include "sample.hpp"
#include "tessera/dynamics/spectral.hpp"
#include "tessera/dynamics/stiffening.hpp"

namespace tessera::test {
namespace {

struct Irregular {
  std::array<int, 3> counts;
  double jitter;
  std::uint64_t seed;
};

/// A box of so many cells, or a sheet in plane strain if there is one layer.
VoronoiBody irregular_body(const Irregular& set) {
  const auto [x, y, z] = set.counts;
  const Solid solid = box({0.25 * x, 0.25 * y, 0.25 * z});
  VoronoiBody body = voronoi_body(solid, set.counts, set.jitter, set.seed, nothing);
  if (z > 1) return body;
  for (Vec3& X : body.X) X.z = 0.125;
  body.cells = voronoi_cells(body.X, solid, Moments::second_of_faces);
  body.D.clear();
  for (const BoundaryFace& f : body.cells.boundary) {
    const Vec3 N = normalized(f.area);
    body.D.push_back(std::abs(N.z) > 0.5 ? outer(N, N) : Mat3{});
  }
  return body;
}

double largest_frequency(const VoronoiBody& body, Integration integration) {
  const System s = system_of(discretize(Method::consistent, body, integration), rubber());
  return SpectralEstimator(s).largest_frequency(reference_state(s), resting_walls(s), s.shortest_length);
}

/// Stencils of second derivatives are so wide that the step stays at least 0.8 of the nodal one on irregular sets, in
/// blocks, in slabs and bars of two, three and four layers, and in two dimensions.
TEST(SecondOrder, KeepsFourFifthsOfTheNodalStep) {
  const std::vector<std::array<int, 3>> bodies{{6, 4, 4},  {5, 5, 5},   {9, 8, 7},  {12, 12, 2}, {12, 12, 3},
                                               {12, 4, 3}, {12, 12, 4}, {12, 4, 1}, {12, 5, 1},  {6, 6, 1}};
  for (const std::array<int, 3>& counts : bodies)
    for (const double jitter : {0.05, 0.1, 0.2, 0.3})
      for (const std::uint64_t seed : {1, 2}) {
        const VoronoiBody body = irregular_body({counts, jitter, seed});
        const double ratio =
            largest_frequency(body, Integration::nodal) / largest_frequency(body, Integration::second_order);
        EXPECT_GT(ratio, 0.8) << counts[0] << " x " << counts[1] << " x " << counts[2] << ", jitter " << jitter
                              << ", seed " << seed;
      }
}

/// The place of a point of the beam bent to a circle by `curvature`.
Vec3 bent(const Vec3& X, double curvature) {
  const double R = 1.0 / curvature, angle = (X.x - 0.75) / R;
  return {(R + X.z - 0.5) * std::sin(angle), X.y, (R + X.z - 0.5) * std::cos(angle) - R};
}

double largest_frequency(const System& s, const State& state) {
  return SpectralEstimator(s).largest_frequency(state, {}, s.shortest_length, {200, 1e-3, 0.0});
}

/// Until stress points are squeezed to a tenth and less, which the mean deformations of cells hardly show.
void expect_bound_in_bending(Integration integration, double jitter, int layers) {
  const System s = system_of(
      discretize(Method::consistent, box({1.5, 1, 1}), {6, layers, layers}, jitter, 1, nothing, integration), rubber());
  Forces forces(s);
  State state = reference_state(s);
  forces.evaluate(state, {}, 0.0);
  Stiffening stiffening(s);
  stiffening.remember(forces);
  const double rest = largest_frequency(s, state);
  for (const double strain_at_edge : {0.3, 0.6, 0.8, 0.9}) {
    for (std::size_t a = 0; a < s.d.X.size(); ++a) state.x[a] = to_kernel(bent(s.d.X[a], 2.0 * strain_at_edge));
    forces.evaluate(state, {}, 0.0);
    EXPECT_GT(forces.sums().smallest_J, 0.0);
    EXPECT_LT(largest_frequency(s, state), 1.02 * std::sqrt(stiffening.growth(forces)) * rest)
        << layers << " layers, jitter " << jitter << ", strain " << strain_at_edge;
  }
}

TEST(Stiffening, BoundsTheGrowthOfTheFrequencyInBending) {
  for (const Integration integration : {Integration::nodal, Integration::cell, Integration::second_order})
    for (const int layers : {4, 5})
      for (const double jitter : {0.0, 0.2}) expect_bound_in_bending(integration, jitter, layers);
}

}  // namespace
}  // namespace tessera::test
