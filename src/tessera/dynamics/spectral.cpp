#include "tessera/dynamics/spectral.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/dynamics/krylov.hpp"
#include "tessera/dynamics/linearised_forces.hpp"

namespace tessera {

namespace {

// A small residual alone may belong to a lower neighbour of the largest value, so the value must also have settled.
constexpr std::size_t settling_looks = 3;
// Products between two looks at the small eigenvalue problem, which costs as much as the forces on a small body.
constexpr int products_per_look = 2;
constexpr double settled_per_tolerance = 0.1;
// What the last vector of an estimate leaves to chance in the next one: another mode may have become the highest.
constexpr double share_of_chance = 0.5;
// For forces without a potential the residual bounds nothing; this covers what the iteration has left.
constexpr double general_margin = 1.05;

/// Says when a bound is good enough.
class Judge {
 public:
  Judge(const Effort& effort, KrylovSpace::Kind kind) : effort_(effort), kind_(kind) {}

  /// Upper bound of the eigenvalue. Once the value has settled it is that and its residual. Before, the length of the
  /// next direction takes the place of the residual: a bound that holds in practice after some four iterations (Zhou
  /// and Li, Bounding the spectrum of large Hermitian matrices, 2011).
  double bound(const Ritz& r) {
    values_.push_back(r.value);
    settled_ =
        values_.size() > settling_looks &&
        r.value - values_[values_.size() - 1 - settling_looks] <= settled_per_tolerance * effort_.tolerance * r.value &&
        r.residual <= effort_.tolerance * r.value;
    exhausted_ = r.next <= 1e-12 * r.value;
    const double value = r.value + (settled_ || exhausted_ ? r.residual : r.next);
    return kind_ == KrylovSpace::Kind::symmetric ? value : general_margin * value;
  }

  bool done(double bound, int evaluations) const {
    if (settled_ || exhausted_ || !std::isfinite(bound)) return true;
    return evaluations >= allowed() || std::sqrt(bound) <= effort_.enough;
  }

  /// Evaluations that the effort allows as far as the frequency is known.
  int allowed() const {
    const double share = effort_.evaluations_per_frequency * std::sqrt(std::max(values_.back(), 0.0));
    return static_cast<int>(std::min(share, static_cast<double>(effort_.evaluations)));
  }

 private:
  Effort effort_;
  KrylovSpace::Kind kind_;
  std::vector<double> values_;
  bool settled_ = false, exhausted_ = false;
};

}  // namespace

Vectors SpectralEstimator::start_vector(const LinearisedForces& K) const {
  Vectors v = rough_vector(K.size(), static_cast<std::uint64_t>(memory_.evaluations));
  K.hold(v);
  const Vectors& last = memory_.vector;
  if (const double l = length(v); l > 0.0) scale(v, (last.empty() ? 1.0 : share_of_chance) / l);
  parallel::for_each(static_cast<std::int64_t>(last.size()),
                     [&](std::int64_t i) { v[static_cast<std::size_t>(i)] += last[static_cast<std::size_t>(i)]; });
  if (const double l = length(v); l > 0.0) scale(v, 1.0 / l);
  return v;
}

double SpectralEstimator::largest_frequency(const State& state, std::span<const Vec3> walls, double L,
                                            const Effort& effort) {
  using enum KrylovSpace::Kind;
  LinearisedForces K(system_, mass_, state, walls, L);
  int evaluations = 1;
  const auto kind = has_potential(system_.d) ? symmetric : general;
  Vectors start = start_vector(K);
  if (inner(start, start) == 0.0) return 0.0;  // every particle is held
  KrylovSpace space(kind, std::move(start));
  Judge judge(effort, kind);
  Vectors w;
  Ritz ritz;
  double bound = 0.0;
  for (int products = fewest_evaluations - 1; products > 0;) {
    for (bool more = true; more && products > 0; --products) {
      K.apply(space.direction(), w);
      ++evaluations;
      more = space.extend(w);
    }
    ritz = space.largest();
    bound = judge.bound(ritz);
    products = judge.done(bound, evaluations) ? 0 : std::min(products_per_look, judge.allowed() - evaluations);
  }
  memory_.vector = space.vector(ritz);
  K.hold(memory_.vector);
  memory_.evaluations += evaluations;
  return std::sqrt(std::max(bound, 0.0));
}

}  // namespace tessera
