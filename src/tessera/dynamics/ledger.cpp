#include "tessera/dynamics/ledger.hpp"

#include "tessera/parallel/parallel.hpp"

namespace tessera {

/// Half of (old + new force) . (new - old place); nothing at the first time.
double Ledger::advance(Memory& memory, std::vector<Vec3> force, std::vector<Vec3> place, double before) {
  double work = 0.0;
  if (before > 0.0)
    for (std::size_t i = 0; i < force.size(); ++i)
      work += 0.5 * dot(memory.force[i] + force[i], place[i] - memory.place[i]);
  memory = {std::move(force), std::move(place)};
  return work;
}

void Ledger::remember(const State& state, const Forces& forces, const Leapfrog& leapfrog, std::span<const Vec3> walls,
                      double before) {
  std::vector<Vec3> force, place;
  for (const NodalForce& l : loads_.tractions.forces()) {
    force.push_back(l.force);
    place.push_back(to_vec3(state.x[static_cast<std::size_t>(l.particle)]));
  }
  external_work_ += advance(tractions_, std::move(force), std::move(place), before);

  // Reactions are forces on the tool, so the tool's work on the body has the opposite sign.
  external_work_ -= advance(walls_, forces.reactions(),
                            std::vector<Vec3>(walls.begin(), walls.begin() + system_.boundary_nodes()), before);

  std::vector<Vec3> held;
  for (const ParticleConstraint& c : system_.d.constraints)
    held.push_back(to_vec3(state.x[static_cast<std::size_t>(c.particle)]));
  external_work_ -= advance(constraints_, leapfrog.reactions(), std::move(held), before);
}

void Ledger::record(const State& state, const Forces& forces, const Leapfrog& leapfrog, std::span<const Vec3> walls,
                    StepPair dt, double before) {
  remember(state, forces, leapfrog, walls, before);
  if (leapfrog.damping() > 0.0) {
    const double power =
        2.0 * leapfrog.damping() * total_motion(state, forces, leapfrog, dt, 0, system_.particles()).kinetic;
    dissipated_ += 0.5 * before * (damping_power_ + power);
    damping_power_ = power;
  }
}

void Ledger::restore(Books books) {
  external_work_ = books.accounts[0];
  dissipated_ = books.accounts[1];
  damping_power_ = books.accounts[2];
  tractions_ = std::move(books.last[0]);
  walls_ = std::move(books.last[1]);
  constraints_ = std::move(books.last[2]);
}

Motion& Motion::operator+=(const Motion& o) {
  kinetic += o.kinetic;
  linear += o.linear;
  angular += o.angular;
  return *this;
}

Motion total_motion(const State& state, const Forces& forces, const Leapfrog& leapfrog, StepPair dt, Index first,
                    Index last) {
  return parallel::sum_ranges<Motion>(first, last, [&](std::int64_t begin, std::int64_t end) {
    Motion sum;
    for (auto a = static_cast<Index>(begin); a < end; ++a) {
      const Vec3 v = leapfrog.velocity(state, forces, dt, a);
      const Vec3 momentum = leapfrog.mass(a) * v;
      sum += {0.5 * dot(momentum, v), momentum, cross(to_vec3(state.x[static_cast<std::size_t>(a)]), momentum)};
    }
    return sum;
  });
}

double gravity_work(const System& system, const State& state, const Field<Double4>& x0, const Vec3& gravity) {
  if (gravity == Vec3{}) return 0.0;
  return parallel::sum<double>(system.particles(), [&](std::int64_t a) {
    const auto k = static_cast<std::size_t>(a);
    return system.mass[k] * dot(gravity, to_vec3(state.x[k] - x0[k]));
  });
}

}  // namespace tessera
