#include "tessera/output/snapshot.hpp"

#include <algorithm>

namespace tessera {

namespace {

/// Entries [begin, end) of those that there are.
template <class T>
std::vector<T> part(const std::vector<T>& all, Index begin, Index end) {
  const auto size = static_cast<Index>(all.size());
  return {all.begin() + std::min(begin, size), all.begin() + std::min(end, size)};
}

}  // namespace

SnapshotSource parts_of(const Snapshot& all) {
  return {all.time, static_cast<Index>(all.position.size()), [&all](Index begin, Index end, Snapshot& taken) {
            const auto cut = [&](const auto& values) { return part(values, begin, end); };
            taken = Snapshot{.time = all.time,
                             .step = all.step,
                             .first = all.first + begin,
                             .body = cut(all.body),
                             .material = cut(all.material),
                             .reference_position = cut(all.reference_position),
                             .position = cut(all.position),
                             .velocity = cut(all.velocity),
                             .force = cut(all.force),
                             .internal_force = cut(all.internal_force),
                             .contact_force = cut(all.contact_force),
                             .external_force = cut(all.external_force),
                             .deformation_gradient = cut(all.deformation_gradient),
                             .first_piola_kirchhoff = cut(all.first_piola_kirchhoff),
                             .volume = cut(all.volume),
                             .mass = cut(all.mass),
                             .energy_density = cut(all.energy_density),
                             .plastic_strain = cut(all.plastic_strain),
                             .cauchy_stress = {}};
          }};
}

}  // namespace tessera
