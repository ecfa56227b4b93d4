#include "tessera/geometry/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/geometry/boundary.hpp"
#include "tessera/geometry/close_pair.hpp"
#include "tessera/geometry/crystal.hpp"
#include "tessera/geometry/lattice.hpp"
#include "tessera/geometry/point_file.hpp"
#include "tessera/geometry/region.hpp"
#include "tessera/geometry/room.hpp"
#include "tessera/geometry/scatter.hpp"
#include "tessera/geometry/solid_surface.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

constexpr double kClosest = 1e-6;  // of the mean spacing
constexpr int kTries = 6;          // of lattices, for a number of particles

std::string at(const Vec3& X) { return fmt::format("({:g}, {:g}, {:g}) m", X.x, X.y, X.z); }

void check_distances(const std::vector<Vec3>& points, double solid_volume, const std::vector<int>& lines) {
  const double spacing = std::cbrt(solid_volume / static_cast<double>(points.size()));
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

/// The lattice over the bounding box of a surface, clipped to it.
PointSet place_lattice_in(const LatticeSpec& spec, const Origin& origin, const SurfaceIndex& index) {
  const Bounds box = bounds(index.surface());
  const Solid around = build_solid(Shape{"", origin, BoxShape{box.lower, box.upper}});
  LatticeSpec still = spec;
  still.jitter = 0.0;
  PointSet set = place_lattice(still, origin, around, Placement::cell_centres);
  const PointSet moved = place_lattice(spec, origin, around, Placement::cell_centres);
  const Vec3& h = set.lattice->spacing;
  const double depth = kLeastDepth * std::min({h.x, h.y, h.z});
  const auto is_fine = [&](const Vec3& X) {
    return index.location(X) == Location::inside && !index.is_nearer_than(depth, X);
  };
  std::vector<char> is_taken(set.points.size(), 0);
  parallel::for_each(static_cast<std::int64_t>(set.points.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    if (!is_fine(set.points[k])) return;
    is_taken[k] = 1;
    const Vec3 move = moved.points[k] - set.points[k];
    for (double part = 1.0; part > 0.1; part *= 0.5)  // in a corner a particle may have no room to move at all
      if (is_fine(set.points[k] + part * move)) {
        set.points[k] += part * move;
        break;
      }
  });
  PointSet inside;
  for (std::size_t k = 0; k < is_taken.size(); ++k)
    if (is_taken[k]) inside.points.push_back(set.points[k]);
  if (inside.points.empty())
    throw InputError(origin, fmt::format("no cell centre of the lattice, with spacings ({:g}, {:g}, {:g}) m, lies in "
                                         "the solid and {:g} spacings away from its surface; choose a finer one",
                                         h.x, h.y, h.z, kLeastDepth));
  return inside;
}

/// Those lattices that come nearest to the number of particles that is asked for.
template <class Place>
PointSet near_count(LatticeSpec spec, double volume, Place&& place) {
  if (!spec.count) return place(spec);
  const double wanted = static_cast<double>(*spec.count);
  spec.spacing = std::cbrt(volume / wanted);
  PointSet best;
  for (int i = 0; i < kTries; ++i) {
    PointSet set = place(spec);
    const auto n = static_cast<double>(set.points.size());
    *spec.spacing *= std::cbrt(n / wanted);
    if (i == 0 || std::abs(n - wanted) < std::abs(static_cast<double>(best.points.size()) - wanted))
      best = std::move(set);
    if (n == wanted) break;
  }
  return best;
}

PointSet place_cubic(const LatticeSpec& lattice, const Origin& origin, const Solid& solid, Placement placement) {
  return near_count(lattice, solid.volume, [&](LatticeSpec spec) {
    spec.count.reset();
    return place_lattice(spec, origin, solid, placement);
  });
}

PointSet place_cubic(const LatticeSpec& lattice, const Origin& origin, const SurfaceIndex& index) {
  return near_count(lattice, volume(index.surface()), [&](LatticeSpec spec) {
    spec.count.reset();
    return place_lattice_in(spec, origin, index);
  });
}

/// Particles of a source that needs to know no more of the solid than its surface.
PointSet place_in_region(const ParticleSpec& spec, const Region& region) {
  if (const auto* lattice = std::get_if<LatticeSpec>(&spec.source))
    return near_count(*lattice, region.size, [&](const LatticeSpec& s) {
      return PointSet{place_crystal(s, spec.origin, region), std::nullopt};
    });
  if (const auto* random = std::get_if<RandomSpec>(&spec.source))
    return {scatter_discs(*random, spec.origin, region), std::nullopt};
  return {scatter_by_size(std::get<RelaxedSpec>(spec.source), spec.origin, region), std::nullopt};
}

/// The boundary of a solid; in two dimensions so much thicker that only its upright sides count.
TriangleSurface boundary_of(const Solid& solid, int dimension) {
  TriangleSurface surface = surface_of(solid);
  if (dimension == 3) return surface;
  const Vec3 size = solid.upper - solid.lower;
  const double middle = 0.5 * (solid.lower.z + solid.upper.z), half = size.x + size.y;
  for (Vec3& X : surface.vertices) X.z = X.z > middle ? middle + half : middle - half;
  return surface;
}

bool is_cubic_lattice(const ParticleSpec& spec) {
  const auto* lattice = std::get_if<LatticeSpec>(&spec.source);
  return lattice != nullptr && lattice->kind == LatticeKind::cubic;
}

[[noreturn]] void refuse_mesh(const Origin& origin) {
  throw InputError(origin, "a mesh brings its own particles, and only formulation = \"delaunay\" can use it");
}

}  // namespace

double Amount::in(double size, int dimension) const {
  if (count) return *count;
  const double part = dimension == 2 ? *spacing * *spacing : *spacing * *spacing * *spacing;
  return std::max(1.0, std::round(size / part));
}

PointSet place_particles(const ParticleSpec& spec, const SurfaceIndex& index) {
  if (std::holds_alternative<MeshFileSpec>(spec.source)) refuse_mesh(spec.origin);
  const double size = volume(index.surface());
  require_room(spec, size, bounds(index.surface()).size());
  if (const auto* source = std::get_if<PointFileSpec>(&spec.source)) {
    FilePoints file = read_points(*source, spec.origin);
    for (std::size_t p = 0; p < file.points.size(); ++p)
      if (index.location(file.points[p]) != Location::inside)
        throw GeometryError(fmt::format("{}:{}: particle {} at {} does not lie inside the surface", source->path,
                                        file.lines[p], p, at(file.points[p])));
    check_distances(file.points, size, file.lines);
    return {std::move(file.points), std::nullopt, std::move(file.radius)};
  }
  PointSet set = is_cubic_lattice(spec) ? place_cubic(std::get<LatticeSpec>(spec.source), spec.origin, index)
                                        : place_in_region(spec, {index, size});
  check_distances(set.points, size, {});
  return set;
}

PointSet place_particles(const ParticleSpec& spec, const Solid& solid, Placement placement) {
  if (std::holds_alternative<MeshFileSpec>(spec.source)) refuse_mesh(spec.origin);
  require_room(spec, solid.volume, solid.upper - solid.lower);
  if (const auto* source = std::get_if<PointFileSpec>(&spec.source)) {
    FilePoints file = read_points(*source, spec.origin);
    check_inside(file, source->path, solid, placement);
    check_distances(file.points, solid.volume, file.lines);
    return {std::move(file.points), std::nullopt, std::move(file.radius)};
  }
  PointSet set;
  if (is_cubic_lattice(spec)) {
    set = place_cubic(std::get<LatticeSpec>(spec.source), spec.origin, solid, placement);
  } else if (placement == Placement::vertices) {
    throw InputError(spec.origin,
                     "formulation = \"delaunay\" takes the vertices of its tetrahedra from a cubic lattice, a file of "
                     "points or a mesh; bcc, fcc, hcp, random and relaxed particles are centres of Voronoi cells, none "
                     "of which lies on the boundary");
  } else {
    const TriangleSurface surface = boundary_of(solid, spec.dimension);
    const SurfaceIndex index(surface);
    const double thickness = spec.dimension == 2 ? solid.upper.z - solid.lower.z : 1.0;
    set =
        place_in_region(spec, {index, solid.volume / thickness, spec.dimension, 0.5 * (solid.lower.z + solid.upper.z)});
  }
  check_distances(set.points, solid.volume, {});
  return set;
}

}  // namespace tessera
