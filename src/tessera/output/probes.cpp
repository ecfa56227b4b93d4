#include "tessera/output/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "tessera/output/motion.hpp"

namespace tessera {

namespace {

std::size_t at(Index particle) { return static_cast<std::size_t>(particle); }

std::vector<double> as_values(const Vec3& v) { return {v.x, v.y, v.z}; }

std::vector<Column> quantity_columns(const ProbeSpec& spec) {
  const Quantity& quantity = find_quantity(spec.quantity, spec.origin);
  std::vector<Column> columns;
  for (const std::string_view suffix : component_suffixes(quantity))
    columns.push_back({fmt::format("{}.{}{}", spec.name, quantity.name, suffix), std::string(quantity.unit)});
  if (spec.kind == ProbeKind::maximum && quantity.components() == 3)
    columns.push_back({fmt::format("{}.{}", spec.name, quantity.name), std::string(quantity.unit)});
  return columns;
}

std::vector<Column> named_columns(const ProbeSpec& spec, std::span<const Column> columns) {
  std::vector<Column> named;
  for (const Column& column : columns) named.push_back({spec.name + "." + column.name, column.unit});
  return named;
}

void check(const ProbeSpec& spec) {
  const bool reads_quantity = spec.kind == ProbeKind::average || spec.kind == ProbeKind::maximum;
  if (spec.kind == ProbeKind::point && !spec.at)
    throw InputError(spec.origin, fmt::format("probe \"{}\" of type point needs `at = [X, Y, Z]`", spec.name));
  if (reads_quantity && spec.quantity.empty())
    throw InputError(spec.origin, fmt::format("probe \"{}\" needs `quantity`, for example \"von_mises\"", spec.name));
  if (reads_quantity) find_quantity(spec.quantity, spec.origin);
}

/// Diagonal of the box around all particles [m].
double size_of(const Snapshot& snapshot) {
  Vec3 lower = snapshot.reference_position.front(), upper = lower;
  for (const Vec3& X : snapshot.reference_position)
    for (int i = 0; i < 3; ++i) lower[i] = std::min(lower[i], X[i]), upper[i] = std::max(upper[i], X[i]);
  return norm(upper - lower);
}

/// The motion of a particle says nothing of a point that is farther from it than all bodies together are large.
void refuse_distant_point(const ProbeSpec& spec, const Snapshot& snapshot, Index nearest) {
  const Vec3& X = *spec.at;
  const double distance = norm(X - snapshot.reference_position[at(nearest)]), size = size_of(snapshot);
  if (size == 0.0 || distance <= size) return;
  throw InputError(spec.origin, fmt::format("probe \"{}\": at = ({:g}, {:g}, {:g}) m is {:.3g} m away from the nearest "
                                            "particle, but all particles lie within {:.3g} m; is a unit missing?",
                                            spec.name, X.x, X.y, X.z, distance, size));
}

}  // namespace

Index nearest_particle(const Snapshot& snapshot, std::span<const Index> candidates, const Vec3& X) {
  return *std::min_element(candidates.begin(), candidates.end(), [&](Index a, Index b) {
    return norm2(snapshot.reference_position[at(a)] - X) < norm2(snapshot.reference_position[at(b)] - X);
  });
}

BoundProbe bind_probe(const ProbeSpec& spec, const Snapshot& snapshot, std::vector<Index> candidates) {
  check(spec);
  if (spec.kind == ProbeKind::reaction) return {spec, {}};
  if (candidates.empty())
    throw InputError(spec.origin, fmt::format("probe \"{}\" takes no particle; widen `where`", spec.name));
  if (spec.kind == ProbeKind::point) {
    candidates = {nearest_particle(snapshot, candidates, *spec.at)};
    refuse_distant_point(spec, snapshot, candidates.front());
  }
  return {spec, std::move(candidates)};
}

std::vector<Column> probe_columns(const ProbeSpec& spec) {
  static const std::array<Column, 6> reaction = {
      {{"fx", "N"}, {"fy", "N"}, {"fz", "N"}, {"tx", "N m"}, {"ty", "N m"}, {"tz", "N m"}}};
  static const std::array<Column, 3> point = {{{"x", "m"}, {"y", "m"}, {"z", "m"}}};
  static const std::array<Column, 6> momenta = {
      {{"px", "kg m/s"}, {"py", "kg m/s"}, {"pz", "kg m/s"}, {"lx", "kg m2/s"}, {"ly", "kg m2/s"}, {"lz", "kg m2/s"}}};
  static const std::array<Column, 2> energies = {{{"kinetic", "J"}, {"internal", "J"}}};
  switch (spec.kind) {
    case ProbeKind::reaction:
      return named_columns(spec, reaction);
    case ProbeKind::point:
      return named_columns(spec, point);
    case ProbeKind::momentum:
      return named_columns(spec, momenta);
    case ProbeKind::energy:
      return named_columns(spec, energies);
    case ProbeKind::average:
    case ProbeKind::maximum:
      break;
  }
  return quantity_columns(spec);
}

std::vector<double> probe_values(const BoundProbe& probe, const Snapshot& snapshot) {
  const ProbeSpec& spec = probe.spec;
  switch (spec.kind) {
    case ProbeKind::reaction:
      break;
    case ProbeKind::point:
      return as_values(moved_point(snapshot, at(probe.particles[0]), *spec.at));
    case ProbeKind::average:
      return average(find_quantity(spec.quantity, spec.origin), snapshot, probe.particles);
    case ProbeKind::maximum:
      return maximum(find_quantity(spec.quantity, spec.origin), snapshot, probe.particles);
    case ProbeKind::momentum: {
      const auto [p, l] = momentum(snapshot, probe.particles);
      return {p.x, p.y, p.z, l.x, l.y, l.z};
    }
    case ProbeKind::energy:
      return {kinetic_energy(snapshot, probe.particles), strain_energy(snapshot, probe.particles)};
  }
  return {};
}

std::vector<double> average(const Quantity& quantity, const Snapshot& snapshot, std::span<const Index> particles) {
  std::vector<double> mean(static_cast<std::size_t>(quantity.components()), 0.0);
  std::array<double, 9> value{};
  double volume = 0.0;
  for (const Index a : particles) {
    evaluate(quantity, snapshot, at(a), value.data());
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += snapshot.volume[at(a)] * value[i];
    volume += snapshot.volume[at(a)];
  }
  for (double& m : mean) m /= volume;
  return mean;
}

std::vector<double> maximum(const Quantity& quantity, const Snapshot& snapshot, std::span<const Index> particles) {
  const auto components = static_cast<std::size_t>(quantity.components());
  std::vector<double> greatest(components, -std::numeric_limits<double>::infinity());
  std::array<double, 9> value{};
  double length = 0.0;
  for (const Index a : particles) {
    evaluate(quantity, snapshot, at(a), value.data());
    for (std::size_t i = 0; i < components; ++i) greatest[i] = std::max(greatest[i], value[i]);
    length = std::max(length, norm(Vec3{value[0], value[1], value[2]}));
  }
  if (components == 3) greatest.push_back(length);
  return greatest;
}

Momentum momentum(const Snapshot& snapshot, std::span<const Index> particles) {
  Momentum sum;
  for (const Index a : particles) {
    const Vec3 p = snapshot.mass[at(a)] * snapshot.velocity[at(a)];
    sum.linear += p;
    sum.angular += cross(snapshot.position[at(a)], p);
  }
  return sum;
}

double kinetic_energy(const Snapshot& snapshot, std::span<const Index> particles) {
  double sum = 0.0;
  for (const Index a : particles) sum += 0.5 * snapshot.mass[at(a)] * norm2(snapshot.velocity[at(a)]);
  return sum;
}

double strain_energy(const Snapshot& snapshot, std::span<const Index> particles) {
  double sum = 0.0;
  for (const Index a : particles) sum += snapshot.volume[at(a)] * snapshot.energy_density[at(a)];
  return sum;
}

}  // namespace tessera
