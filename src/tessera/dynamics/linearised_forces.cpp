#include "tessera/dynamics/linearised_forces.hpp"

#include <cmath>

namespace tessera {

namespace {

constexpr double share_of_length = 1e-5;

}  // namespace

LinearisedForces::LinearisedForces(const System& system, std::span<const double> mass, const State& state,
                                   std::span<const Vec3> walls, double L)
    : system_(system),
      mass_(mass),
      forces_(system, Flow::held),
      state_(state),
      moved_{state.x, {}, state.plastic},
      action_{walls, {}, {}},
      amplitude_(share_of_length * L) {
  forces_.evaluate(moved_, action_, 0.0);
  f_ = forces_.total();
}

void LinearisedForces::hold(Vectors& w) const {
  for (const ParticleConstraint& c : system_.d.constraints) {
    Double4& v = w[static_cast<std::size_t>(c.particle)];
    v = to_kernel(to_vec3(v) - c.D * to_vec3(v));
  }
}

void LinearisedForces::apply(const Vectors& w, Vectors& result) {
  const auto n = static_cast<std::int64_t>(size());
  const double largest = largest_of(n, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    return dot3(w[a], w[a]) / mass_[a];
  });
  const double epsilon = amplitude_ / std::sqrt(largest);
  parallel::for_each(n, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    moved_.x[a] = state_.x[a] + (epsilon / std::sqrt(mass_[a])) * w[a];
  });
  forces_.evaluate(moved_, action_, 0.0);
  result.resize(w.size());
  parallel::for_each(n, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    result[a] = (1.0 / (epsilon * std::sqrt(mass_[a]))) * (f_[a] - forces_.total()[a]);
  });
  hold(result);
}

}  // namespace tessera
