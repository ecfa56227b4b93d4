#include "tessera/dynamics/leapfrog.hpp"

#include "tessera/base/fetch.hpp"
#include "tessera/base/kernel.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

Leapfrog::Leapfrog(const System& system, const Loads& loads, double damping, std::span<const double> mass)
    : system_(system), loads_(loads), damping_(damping), mass_(mass) {
  const auto& constraints = system.d.constraints;
  if (constraints.empty()) return;
  constraint_of_.assign(system.d.X.size(), -1);
  for (std::size_t i = 0; i < constraints.size(); ++i)
    constraint_of_[static_cast<std::size_t>(constraints[i].particle)] = static_cast<Index>(i);
  next_velocity_.resize(constraints.size());
  reactions_.resize(constraints.size());
}

namespace {

/// Of one step.
struct Kick {
  Kick(double damping, double length) : drag(0.5 * damping * length), h(length) {}

  Double4 operator()(const Double4& v, const Double4& force, double mass) const {
    return ((1.0 - drag) * v + (h / mass) * force) * (1.0 / (1.0 + drag));
  }

  double drag, h;
};

/// Velocities that are prescribed: of each particle its place in `velocity`, or -1; null without any.
struct Prescribed {
  const Index* place;
  const Vec3* velocity;
};

/// Kick and drift of `count` particles.
TESSERA_KERNEL void kick_and_drift(const Kick& kick, double dt, const Double4* force, const double* mass,
                                   const Prescribed& prescribed, Double4* v, Double4* x, Index count) {
  for (Index a = 0; a < count; ++a) {
    fetch_to_write<2048>(v + a);
    fetch_to_write<2048>(x + a);
    fetch_ahead<1024>(mass + a);
    v[a] = kick(v[a], force[a], mass[a]);
    if (prescribed.place != nullptr && prescribed.place[a] >= 0)
      v[a] = to_kernel(prescribed.velocity[prescribed.place[a]]);
    x[a] += dt * v[a];
  }
}

}  // namespace

Double4 Leapfrog::free_kick(const State& state, const Double4& force, double h, Index a) const {
  const auto k = static_cast<std::size_t>(a);
  return Kick(damping_, h)(state.v[k], force, mass_[k]);
}

Vec3 Leapfrog::constrained_velocity(const State& state, std::size_t i, double dt, const Vec3& free) const {
  const ParticleConstraint& c = system_.d.constraints[i];
  const Vec3 x = to_vec3(state.x[static_cast<std::size_t>(c.particle)]);
  const Vec3 prescribed = (1.0 / dt) * (loads_.motion.positions()[i] - x);
  return c.D * (prescribed - free) + free;
}

void Leapfrog::start(State& state, const Forces& forces, double dt) const {
  const Double4* force = forces.total().data();
  parallel::for_each(system_.particles(), [&](std::int64_t a) {
    const auto k = static_cast<std::size_t>(a);
    const Double4 acceleration = (1.0 / mass_[k]) * force[k] - damping_ * state.v[k];
    state.v[k] -= (0.5 * dt) * acceleration;
  });
  for (std::size_t i = 0; i < system_.d.constraints.size(); ++i) {
    const auto k = static_cast<std::size_t>(system_.d.constraints[i].particle);
    state.v[k] = to_kernel(constrained_velocity(state, i, dt, to_vec3(state.v[k])));
  }
}

void Leapfrog::prepare(const State& state, const Forces& forces, StepPair dt) {
  const double h = dt.middle();
  for (std::size_t i = 0; i < system_.d.constraints.size(); ++i) {
    const ParticleConstraint& c = system_.d.constraints[i];
    const auto k = static_cast<std::size_t>(c.particle);
    if (h == 0.0) {  // a single evaluation: what is held does not accelerate
      next_velocity_[i] = to_vec3(state.v[k]);
      reactions_[i] = c.D * to_vec3(forces.total()[k]);
      continue;
    }
    next_velocity_[i] =
        constrained_velocity(state, i, dt.after, to_vec3(free_kick(state, forces.total()[k], h, c.particle)));
    const Vec3 v_minus = to_vec3(state.v[k]), change = next_velocity_[i] - v_minus;
    const Vec3 needed = mass_[k] * ((1.0 / h) * change + (0.5 * damping_) * (v_minus + next_velocity_[i]));
    reactions_[i] = c.D * (to_vec3(forces.total()[k]) - needed);
  }
}

void Leapfrog::step(State& state, const Forces& forces, StepPair dt) const {
  const Kick kick(damping_, dt.middle());
  forces.for_ranges_of_total([&](Index first, Index last, const Double4* force) {
    const Prescribed prescribed{constraint_of_.empty() ? nullptr : constraint_of_.data() + first,
                                next_velocity_.data()};
    kick_and_drift(kick, dt.after, force, mass_.data() + first, prescribed, state.v.data() + first,
                   state.x.data() + first, last - first);
  });
}

Vec3 Leapfrog::velocity(const State& state, const Forces& forces, StepPair dt, Index a) const {
  const auto k = static_cast<std::size_t>(a);
  const bool constrained = !constraint_of_.empty() && constraint_of_[k] >= 0;
  const Vec3 v_plus = constrained ? next_velocity_[static_cast<std::size_t>(constraint_of_[k])]
                                  : to_vec3(free_kick(state, forces.total()[k], dt.middle(), a));
  const Vec3 v_minus = to_vec3(state.v[k]);
  if (dt.middle() == 0.0) return v_minus;
  return v_minus + (dt.before / (dt.before + dt.after)) * (v_plus - v_minus);
}

}  // namespace tessera
