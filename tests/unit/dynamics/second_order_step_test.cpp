#include "sample.hpp"
#include "tessera/dynamics/spectral.hpp"
#include "tessera/dynamics/stiffening.hpp"

namespace tessera::test {
namespace {

double largest_frequency_of_beam(std::uint64_t seed, Integration integration) {
  const System s =
      system_of(discretize(Method::consistent, box({1.5, 1, 1}), {6, 4, 4}, 0.2, seed, nothing, integration), rubber());
  return SpectralEstimator(s).largest_frequency(reference_state(s), {}, s.shortest_length);
}

/// Stencils of second derivatives are so wide that the step stays at least 0.8 of the nodal one on irregular sets.
TEST(SecondOrder, KeepsFourFifthsOfTheNodalStep) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double nodal = largest_frequency_of_beam(seed, Integration::nodal);
    const double second = largest_frequency_of_beam(seed, Integration::second_order);
    RecordProperty("ratio_" + std::to_string(seed), std::to_string(nodal / second));
    EXPECT_GT(nodal, 0.8 * second) << "seed " << seed;
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
    for (const int layers : {3, 4})
      for (const double jitter : {0.0, 0.2}) expect_bound_in_bending(integration, jitter, layers);
}

}  // namespace
}  // namespace tessera::test
