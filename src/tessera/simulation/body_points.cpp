#include "tessera/simulation/body_points.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// In two dimensions a lattice has one layer of cells, so its spacing counts in the plane only.
ParticleSpec in_plane(const BodySpec& body, const Solid& solid, Placement placement) {
  ParticleSpec spec = body.particles;
  auto* lattice = std::get_if<LatticeSpec>(&spec.source);
  if (lattice == nullptr) return spec;
  const int layers = placement == Placement::vertices ? 2 : 1;
  if (lattice->count) {
    const Vec3 size = solid.upper - solid.lower;
    lattice->spacing = std::sqrt(solid.volume / size.z / *lattice->count);
    lattice->count.reset();
  }
  if (lattice->spacing) {
    const Vec3 size = solid.upper - solid.lower;
    const auto count = [&](double length) {
      return std::max(1, static_cast<int>(std::lround(length / *lattice->spacing))) + layers - 1;
    };
    lattice->counts = std::array<int, 3>{count(size.x), count(size.y), layers};
    lattice->spacing.reset();
  } else {
    (*lattice->counts)[2] = layers;
  }
  return spec;
}

}  // namespace

PointSet points_of(const Case& c, const BodySpec& body, const Solid& solid) {
  const Placement placement =
      c.method.formulation == Formulation::delaunay ? Placement::vertices : Placement::cell_centres;
  if (c.method.dimension == 3) return place_particles(body.particles, solid, placement);
  PointSet points = place_particles(in_plane(body, solid, placement), solid, placement);
  if (placement == Placement::cell_centres)
    for (Vec3& X : points.points) X.z = 0.5 * (solid.lower.z + solid.upper.z);
  return points;
}

}  // namespace tessera
