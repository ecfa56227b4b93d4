#include "sample.hpp"
#include "tessera/dynamics/spectral.hpp"

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

}  // namespace
}  // namespace tessera::test
