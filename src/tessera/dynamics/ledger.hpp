#pragma once

#include <array>
#include <vector>

#include "tessera/dynamics/leapfrog.hpp"

namespace tessera {

/// Keeps account of the work that enters and leaves a system step by step (trapezoidal rule, second order like the
/// integrator): tractions, prescribed motion, damping and viscosity. The work of gravity needs no account; it is a
/// potential.
class Ledger {
 public:
  Ledger(const System& system, const Loads& loads) : system_(system), loads_(loads) {}

  /// Records the present time; `walls` are the boundary nodes' prescribed points at this time, `before` the step that
  /// led here (zero at the start). Call after Leapfrog::prepare.
  void record(const State& state, const Forces& forces, const Leapfrog& leapfrog, std::span<const Vec3> walls,
              StepPair dt, double before);

  /// Adds viscous work, which the forces know after each evaluation [J].
  void add_dissipated(double work) { dissipated_ += work; }

  double external_work() const { return external_work_; }  // without gravity [J]
  double dissipated() const { return dissipated_; }        // [J]

  /// Forces and places at the last recorded time.
  struct Memory {
    std::vector<Vec3> force, place;
  };
  /// Everything that a resumed run must put back.
  struct Books {
    std::array<double, 3> accounts{};  // external work, dissipated, damping power
    std::array<Memory, 3> last;        // of tractions, walls and constrained particles
  };
  Books books() const { return {{external_work_, dissipated_, damping_power_}, {tractions_, walls_, constraints_}}; }
  void restore(Books books);

 private:
  static double advance(Memory& memory, std::vector<Vec3> force, std::vector<Vec3> place, double before);
  void remember(const State& state, const Forces& forces, const Leapfrog& leapfrog, std::span<const Vec3> walls,
                double before);

  const System& system_;
  const Loads& loads_;
  Memory tractions_, walls_, constraints_;
  double external_work_ = 0.0, dissipated_ = 0.0, damping_power_ = 0.0;
};

/// Kinetic energy [J] and momenta at the present time.
struct Motion {
  double kinetic = 0.0;
  Vec3 linear;   // [kg m/s]
  Vec3 angular;  // about the origin [kg m2/s]

  Motion& operator+=(const Motion& o);
};

/// Sums over the particles [first, last), with the masses of the leapfrog.
Motion total_motion(const State& state, const Forces& forces, const Leapfrog& leapfrog, StepPair dt, Index first,
                    Index last);

/// Work of gravity since the reference positions `x0` [J].
double gravity_work(const System& system, const State& state, const Field<Double4>& x0, const Vec3& gravity);

}  // namespace tessera
