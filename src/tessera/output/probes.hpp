#pragma once

#include <span>
#include <vector>

#include "tessera/output/history.hpp"
#include "tessera/output/output_spec.hpp"
#include "tessera/output/quantities.hpp"
#include "tessera/output/snapshot.hpp"

namespace tessera {

/// A probe and the particles that it reads, by their numbers in the snapshot: for `point` the one that is nearest in
/// the reference state, for `average` and `maximum` those selected, for `momentum` and `energy` those of the body, for
/// `reaction` none (the caller knows the reactions).
struct BoundProbe {
  ProbeSpec spec;
  std::vector<Index> particles;
};

/// The particle among `candidates` whose reference position is nearest to X; of equals the first.
Index nearest_particle(const Snapshot& snapshot, std::span<const Index> candidates, const Vec3& X);

/// Ties a probe to the particles that it may read: those of its body that `where` takes. Throws InputError at the
/// spec's origin when there are none, when `at` (point) or a known `quantity` (average, maximum) is missing, or when
/// `at` is farther from the nearest of them than the box around all particles is large.
BoundProbe bind_probe(const ProbeSpec& spec, const Snapshot& snapshot, std::vector<Index> candidates);

/// The probe's columns, each named NAME.SOMETHING:
///   reaction  fx, fy, fz [N], tx, ty, tz (torque about the point `about`) [N m]
///   point     x, y, z [m]
///   average   QUANTITY, or QUANTITY_x .. (vector), QUANTITY_xx .. (tensor)
///   maximum   as average; for vectors also QUANTITY, the greatest length
///   momentum  px, py, pz [kg m/s], lx, ly, lz (about the origin) [kg m2/s]
///   energy    kinetic, internal [J]
std::vector<Column> probe_columns(const ProbeSpec& spec);

/// The values of these columns. For `reaction` none.
std::vector<double> probe_values(const BoundProbe& probe, const Snapshot& snapshot);

/// Mean of each component over `particles`, weighted with their reference volumes.
std::vector<double> average(const Quantity& quantity, const Snapshot& snapshot, std::span<const Index> particles);

/// Greatest value of each component over `particles` (with its sign); for vectors followed by the greatest length.
std::vector<double> maximum(const Quantity& quantity, const Snapshot& snapshot, std::span<const Index> particles);

/// Linear and angular momentum of `particles`, the latter about the origin.
Momentum momentum(const Snapshot& snapshot, std::span<const Index> particles);

/// sum m v^2 / 2 over `particles` [J].
double kinetic_energy(const Snapshot& snapshot, std::span<const Index> particles);

/// sum V U(F) over `particles` [J].
double strain_energy(const Snapshot& snapshot, std::span<const Index> particles);

}  // namespace tessera
