#include "tessera/dynamics/time_step.hpp"

#include "sample.hpp"
#include "tessera/dynamics/mass_scaling.hpp"

namespace tessera::test {
namespace {

System cube(Method method, double jitter, std::uint64_t seed, const Constrain& constrain = nothing, int cells = 4) {
  return system_of(discretize(method, box({1, 1, 1}), {cells, cells, cells}, jitter, seed, constrain), rubber());
}

double estimate(SpectralEstimator& estimator, const System& s, const Effort& effort) {
  return estimator.largest_frequency(reference_state(s), resting_walls(s), s.shortest_length, effort);
}

double exact(const System& s) {
  SpectralEstimator estimator(s);
  return estimate(estimator, s, {200, 1e-4, 0.0});
}

/// The fewest evaluations give a bound: not below (half a per cent where it has settled), and no more than a fifth
/// above.
TEST(Effort, OfFewEvaluationsStillGivesABound) {
  for (Method method : {Method::delaunay, Method::consistent, Method::quasi_static})
    for (double jitter : {0.0, 0.25, 0.45})
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        // Lattices can be split into tetrahedra without CGAL, but not when they are that irregular.
        if (method == Method::delaunay && jitter > 0.3 && !TESSERA_TEST_WITH_CGAL) continue;
        const System s = cube(method, jitter, seed, seed % 2 == 0 ? mixed : nothing);
        const double omega = exact(s);
        for (int evaluations : {6, 8, 12}) {
          SpectralEstimator estimator(s);
          const double bound = estimate(estimator, s, {evaluations, 0.02, 0.0});
          EXPECT_LE(estimator.memory().evaluations, evaluations);
          EXPECT_GT(bound, 0.995 * omega) << name_of(method) << " " << jitter << " " << evaluations;
          EXPECT_LT(bound, 1.2 * omega) << name_of(method) << " " << jitter << " " << evaluations;
        }
      }
}

TEST(Effort, EndsWhenTheBoundIsEnough) {
  const System s = cube(Method::consistent, 0.25, 1);
  const double omega = exact(s);
  SpectralEstimator estimator(s);
  estimate(estimator, s, {80, 1e-4, 3.0 * omega});
  EXPECT_EQ(estimator.memory().evaluations, SpectralEstimator::fewest_evaluations);
}

TEST(Effort, GrowsWithTheFrequency) {
  const System s = cube(Method::consistent, 0.25, 1);
  const double omega = exact(s);
  SpectralEstimator estimator(s);
  estimate(estimator, s, {80, 1e-6, 0.0, 10.5 / omega});
  EXPECT_EQ(estimator.memory().evaluations, 10);
}

/// A second estimate starts from the vector of the first and needs about half as many evaluations.
TEST(Effort, IsLessTheSecondTime) {
  const System s = cube(Method::consistent, 0.25, 2, nothing, 8);
  SpectralEstimator estimator(s);
  const Effort effort{80, 0.02, 0.0};
  const double first_bound = estimate(estimator, s, effort);
  const std::int64_t first = estimator.memory().evaluations;
  const double second_bound = estimate(estimator, s, effort);
  EXPECT_LT(estimator.memory().evaluations - first, 0.7 * static_cast<double>(first));
  EXPECT_NEAR(second_bound / first_bound, 1.0, 0.02);
}

TEST(StableStep, HasAnInverse) {
  Material m = rubber();
  m.viscosity = {0.3, 0.0};
  const System viscous = system_of(discretize(Method::consistent, box({1, 1, 1}), {3, 3, 3}, 0.0, 3, nothing), m);
  const System elastic = cube(Method::consistent, 0.0, 1);
  for (double omega : {10.0, 1000.0}) {
    EXPECT_NEAR(frequency_of_step(viscous, stable_step(viscous, omega)) / omega, 1.0, 1e-12);
    EXPECT_NEAR(frequency_of_step(elastic, stable_step(elastic, omega)) / omega, 1.0, 1e-12);
  }
}

/// Uniform strain: the growth of the wave modulus; frequencies grow by no more than its root.
TEST(Stiffening, BoundsTheGrowthOfTheFrequency) {
  for (Method method : {Method::delaunay, Method::consistent})
    for (const Mat3& F : {diagonal(1, 1, 0.5), diagonal(0.6, 0.6, 0.6), diagonal(0.8, 1.2, 0.9)}) {
      const System s = cube(method, 0.25, 1, nothing, 6);
      State state = reference_state(s);
      Forces forces(s);
      forces.evaluate(state, {resting_walls(s), {}, {}}, 0.0);
      Stiffening stiffening(s);
      stiffening.remember(forces);
      EXPECT_NEAR(stiffening.growth(forces), 1.0, 1e-12);
      for (std::size_t a = 0; a < s.d.X.size(); ++a) state.x[a] = to_kernel(F * s.d.X[a]);
      forces.evaluate(state, {resting_walls(s), {}, {}}, 0.0);
      const double growth = stiffening.growth(forces);
      const NeoHookean law = std::get<NeoHookean>(s.materials[0].law);
      EXPECT_NEAR(growth, law.wave_modulus(F) / law.plane_wave_modulus(), 1e-6);
      SpectralEstimator estimator(s);
      const double omega = estimator.largest_frequency(state, resting_walls(s), s.shortest_length, {200, 1e-4, 0.0});
      EXPECT_LT(omega, 1.02 * std::sqrt(growth) * exact(s)) << name_of(method);
    }
}

/// The step that was wanted is stable with the scaled masses, and not much more than needed was added.
TEST(MassScaling, ReachesTheStepThatIsWanted) {
  for (Method method : {Method::delaunay, Method::consistent})
    for (double gain : {1.2, 2.0, 4.0}) {
      const System s = cube(method, 0.3, 3, mixed);
      const double safety = 0.8, step = gain * safety * stable_step(s, exact(s));
      const MassScaling scaling = scale_mass(s, reference_state(s), resting_walls(s), step, safety);
      SpectralEstimator estimator(s, scaling.mass);
      const double reached = safety * stable_step(s, estimate(estimator, s, {200, 1e-4, 0.0}));
      EXPECT_GT(reached, 0.995 * step);
      EXPECT_LT(reached, 1.1 * step);
      EXPECT_GT(scaling.evaluations, 17);
      EXPECT_GT(scaling.added_share, 0.0);
      EXPECT_LT(scaling.added_share, gain * gain - 1.0);
      EXPECT_LE(scaling.particles, s.particles());
      const auto most = static_cast<std::size_t>(scaling.most_affected);
      EXPECT_DOUBLE_EQ(scaling.mass[most] / s.mass[most], scaling.largest_factor);
      for (std::size_t a = 0; a < s.mass.size(); ++a) EXPECT_GE(scaling.mass[a], s.mass[a]);
    }
}

TEST(MassScaling, AddsNothingToAShorterStep) {
  const System s = cube(Method::consistent, 0.3, 3);
  const double step = 0.1 * stable_step(s, exact(s));
  const MassScaling scaling = scale_mass(s, reference_state(s), resting_walls(s), step, 0.8);
  EXPECT_EQ(scaling.particles, 0);
  EXPECT_EQ(scaling.added, 0.0);
  EXPECT_EQ(scaling.mass, s.mass);
}

}  // namespace
}  // namespace tessera::test
