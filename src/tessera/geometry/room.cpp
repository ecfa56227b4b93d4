#include "tessera/geometry/room.hpp"

#include <fmt/format.h>

#include "tessera/base/memory.hpp"

namespace tessera {
namespace {

// Less than any method keeps for a particle, so that nothing is refused that would fit [bytes].
constexpr double kLeastBytes = 600.0;

double per_unit_cell(LatticeKind kind) {
  if (kind == LatticeKind::cubic) return 1.0;
  return kind == LatticeKind::bcc ? 2.0 : 4.0;
}

/// About how many particles a source asks for; none of a file, which says itself.
struct Estimate {
  int dimension;
  double volume;
  Vec3 extent;

  double operator()(const LatticeSpec& s) const {
    if (s.count) return *s.count;
    if (s.spacing) return of({{}, s.spacing});
    if (!s.counts) return 0.0;
    const double box = extent.x * extent.y * extent.z;
    double cells = 1.0;
    for (const int count : *s.counts) cells *= count;
    return cells * per_unit_cell(s.kind) * volume / box;
  }
  double operator()(const RandomSpec& s) const { return of(s.amount); }
  double operator()(const RelaxedSpec& s) const { return of(s.amount); }
  double operator()(const PointFileSpec&) const { return 0.0; }
  double operator()(const MeshFileSpec&) const { return 0.0; }

  double of(const Amount& amount) const {
    if (!amount.count && !(amount.spacing && *amount.spacing > 0.0)) return 0.0;  // which others refuse
    return amount.in(dimension == 2 ? volume / extent.z : volume, dimension);
  }
};

}  // namespace

void require_room(const ParticleSpec& spec, double volume, const Vec3& extent) {
  const std::optional<double> available = available_memory();
  if (!available) return;
  const double particles = std::visit(Estimate{spec.dimension, volume, extent}, spec.source);
  const double needed = kLeastBytes * particles;
  if (needed <= *available) return;
  throw InputError(spec.origin,
                   fmt::format("about {:.2g} particles need {:.0f} GB at the least, and {:.0f} GB of memory "
                               "are free; choose a larger spacing or fewer particles",
                               particles, 1e-9 * needed, 1e-9 * *available));
}

}  // namespace tessera
