#include "tessera/dynamics/mass_scaling.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/dynamics/linearised_forces.hpp"
#include "tessera/dynamics/time_step.hpp"

namespace tessera {

namespace {

// Where the masses that the measure of stiffness asks for leave the highest frequency below the wanted one, all of them
// can be smaller in the same ratio. A few repetitions gain nearly all of it.
constexpr int reductions = 3;
constexpr double negligible_reduction = 0.02;
// Rough vectors for the sizes of rows, which are then known to about a tenth.
constexpr int probes = 16;
constexpr Effort effort{81, 2e-3, 0.0};

MassScaling with_masses(const System& s, std::vector<double> mass) {
  MassScaling scaling;
  double total = 0.0;
  for (std::size_t a = 0; a < mass.size(); ++a) {
    total += s.mass[a];
    scaling.added += mass[a] - s.mass[a];
    const double factor = mass[a] / s.mass[a];
    if (factor > 1.0) ++scaling.particles;
    if (factor > scaling.largest_factor) {
      scaling.largest_factor = factor;
      scaling.most_affected = static_cast<Index>(a);
    }
  }
  scaling.added_share = scaling.added / total;
  scaling.mass = std::move(mass);
  return scaling;
}

/// Sizes of the rows of the stiffness matrix [N/m]: rough vectors v have independent components of one mean square, so
/// the mean square of row a of K v is that times the sum of squares of the row.
std::vector<double> row_sizes(const System& s, const State& state, std::span<const Vec3> walls) {
  const std::vector<double> ones(s.mass.size(), 1.0);
  LinearisedForces K(s, ones, state, walls, s.shortest_length);
  std::vector<double> sizes(ones.size(), 0.0);
  Vectors w;
  for (int probe = 0; probe < probes; ++probe) {
    Vectors v = rough_vector(ones.size(), static_cast<std::uint64_t>(probe));
    K.hold(v);
    K.apply(v, w);
    for (std::size_t a = 0; a < sizes.size(); ++a) sizes[a] += dot3(w[a], w[a]);
  }
  for (double& size : sizes) size = std::sqrt(12.0 / (3.0 * probes) * size);  // components have the mean square 1/12
  return sizes;
}

std::vector<double> at_least(std::vector<double> mass, double factor, const std::vector<double>& stiffness) {
  for (std::size_t a = 0; a < mass.size(); ++a) mass[a] = std::max(mass[a], factor * stiffness[a]);
  return mass;
}

}  // namespace

MassScaling scale_mass(const System& s, const State& state, std::span<const Vec3> walls, double step, double safety) {
  const double omega = frequency_of_step(s, step / safety);
  std::int64_t evaluations = probes + 1;
  const auto highest = [&](const std::vector<double>& mass) {
    SpectralEstimator estimator(s, mass);
    const double frequency = estimator.largest_frequency(state, walls, s.shortest_length, effort);
    evaluations += estimator.memory().evaluations;
    return frequency;
  };
  std::vector<double> k = row_sizes(s, state, walls);
  for (std::size_t a = 0; a < k.size(); ++a)
    if (k[a] == 0.0) k[a] = s.mass[a];  // held: any value does
  const double square_root_of_rho = highest(k);
  double factor = std::pow(square_root_of_rho / omega, 2);
  std::vector<double> mass = at_least(s.mass, factor, k);
  for (int i = 0; i < reductions; ++i) {
    const double reduction = std::pow(highest(mass) / omega, 2);
    if (reduction > 1.0 - negligible_reduction) break;
    factor *= reduction;
    mass = at_least(s.mass, factor, k);
  }
  MassScaling scaling = with_masses(s, std::move(mass));
  scaling.evaluations = evaluations;
  return scaling;
}

}  // namespace tessera
