#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/mat3.hpp"

namespace tessera {

/// The state of all particles at one time, in the order in which the user gave or generated the particles
/// (not the order in memory), or of consecutive ones among them. Velocities belong to the same time as positions.
struct Snapshot {
  double time = 0.0;      // [s]
  std::int64_t step = 0;  // steps done
  Index first = 0;        // number of the first particle

  std::vector<Index> body;                  // number of the body
  std::vector<Index> material;              // number of the material
  std::vector<Vec3> reference_position;     // X_a [m]
  std::vector<Vec3> position;               // x_a [m]
  std::vector<Vec3> velocity;               // [m/s]
  std::vector<Vec3> force;                  // total: internal + contact + external + reactions [N]
  std::vector<Vec3> internal_force;         // from P, [D 45], reactions of boundary faces included [N]
  std::vector<Vec3> contact_force;          // from the bonds, [D 50] [N]
  std::vector<Vec3> external_force;         // tractions, gravity and damping [N]
  std::vector<Mat3> deformation_gradient;   // F_a [-]
  std::vector<Mat3> first_piola_kirchhoff;  // P_a, viscous part included [Pa]
  std::vector<double> volume;               // V_a, reference [m3]
  std::vector<double> mass;                 // [kg]
  std::vector<double> energy_density;       // U(F_a) [J/m3]
  std::vector<double> plastic_strain;       // equivalent; zero where nothing flows
  std::vector<Mat3> cauchy_stress;          // kept by who needs it several times, or else empty [Pa]
};

/// A state of which snapshots can be taken piece by piece, so that the whole need not be held at once.
struct SnapshotSource {
  double time = 0.0;    // [s]
  Index particles = 0;  // in all
  /// Makes `part` particles [begin, end), by the user's numbers; its memory is used again. May be called from several
  /// threads at once; the state must not have moved on.
  std::function<void(Index begin, Index end, Snapshot& part)> take;

  Snapshot part(Index begin, Index end) const {
    Snapshot s;
    take(begin, end, s);
    return s;
  }
};

/// The pieces of a snapshot of all particles, which must outlive them.
SnapshotSource parts_of(const Snapshot& all);

/// The energies of a system at one time [J].
struct EnergyLedger {
  double kinetic = 0.0;
  double internal = 0.0;
  double contact = 0.0;
  double external_work = 0.0;    // of tractions, gravity and prescribed motion, since the start
  double dissipated = 0.0;       // by viscosity, damping and plastic flow, since the start
  double initial = 0.0;          // kinetic + internal + contact at the start
  double scale = 0.0;            // largest energy seen so far, the measure for the relative error
  double largest_contact = 0.0;  // seen so far
  double largest_strain = 0.0;   // internal + contact, seen so far
  double negligible = 0.0;       // what is below may be round-off

  double error() const { return kinetic + internal + contact + dissipated - external_work - initial; }
  double relative_error() const {
    const double measure = std::max(scale, negligible);
    return measure > 0.0 ? error() / measure : 0.0;
  }
  double strain() const { return internal + contact; }
  /// Share of the bonds in the strain energy, which they stabilise; not a number without strain.
  double contact_share() const { return share(contact, strain()); }
  /// Largest energy of the bonds over the largest strain energy; not a number without strain.
  double largest_contact_share() const { return share(largest_contact, largest_strain); }

 private:
  double share(double part, double whole) const {
    return whole > negligible ? part / whole : std::numeric_limits<double>::quiet_NaN();
  }
};

struct Momentum {
  Vec3 linear;   // [kg m/s]
  Vec3 angular;  // about the origin [kg m2/s]
};

}  // namespace tessera
