#include "tessera/geometry/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/geometry/boundary.hpp"
#include "tessera/geometry/close_pair.hpp"
#include "tessera/geometry/lattice.hpp"
#include "tessera/geometry/point_file.hpp"

namespace tessera {
namespace {

constexpr double kClosest = 1e-6;  // of the mean spacing

std::string at(const Vec3& X) { return fmt::format("({:g}, {:g}, {:g}) m", X.x, X.y, X.z); }

void check_distances(const std::vector<Vec3>& points, const Solid& solid, const std::vector<int>& lines) {
  const double spacing = std::cbrt(solid.volume / static_cast<double>(points.size()));
  const auto pair = find_close_pair(points, kClosest * spacing);
  if (!pair) return;
  const auto named = [&](Index particle) {
    const auto p = static_cast<std::size_t>(particle);
    return fmt::format("{} at {}{}", particle, at(points[p]), lines.empty() ? "" : fmt::format(" (line {})", lines[p]));
  };
  throw GeometryError(
      fmt::format("particles {} and {} are closer to each other than {:g} of the mean spacing {:g} m; "
                  "leave one of them out",
                  named(pair->first), named(pair->second), kClosest, spacing));
}

void check_inside(const FilePoints& file, const std::string& path, const Solid& solid, Placement placement) {
  const Vec3 size = solid.upper - solid.lower;
  const double tolerance = 1e-9 * std::max({size.x, size.y, size.z});
  for (std::size_t p = 0; p < file.points.size(); ++p) {
    const Vec3& X = file.points[p];
    if (!solid.contains(X, tolerance))
      throw GeometryError(fmt::format("{}:{}: particle {} at {} lies outside the solid, whose bounding box is {} to {}",
                                      path, file.lines[p], p, at(X), at(solid.lower), at(solid.upper)));
    if (placement == Placement::cell_centres && !is_well_inside(solid, X, tolerance))
      throw GeometryError(
          fmt::format("{}:{}: particle {} at {} lies on the boundary of the solid; the centres of Voronoi "
                      "cells must lie inside",
                      path, file.lines[p], p, at(X)));
  }
}

}  // namespace

PointSet place_particles(const ParticleSpec& spec, const Solid& solid, Placement placement) {
  if (const auto* lattice = std::get_if<LatticeSpec>(&spec.source)) {
    PointSet set = place_lattice(*lattice, spec.origin, solid, placement);
    check_distances(set.points, solid, {});
    return set;
  }
  if (const auto* source = std::get_if<PointFileSpec>(&spec.source)) {
    FilePoints file = read_points(*source, spec.origin);
    check_inside(file, source->path, solid, placement);
    check_distances(file.points, solid, file.lines);
    return {std::move(file.points), std::nullopt};
  }
  throw InputError(spec.origin, "a mesh brings its own particles, and only formulation = \"delaunay\" can use it");
}

}  // namespace tessera
