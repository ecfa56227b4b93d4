#include "tessera/simulation/meshed_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/geometry/room.hpp"
#include "tessera/geometry/shape_surface.hpp"
#include "tessera/geometry/surface_index.hpp"
#include "tessera/tessellation/surface_mesh.hpp"

namespace tessera {

namespace {

constexpr int kSizeSamples = 64;  // along the longest side of the box around a surface, to find the mean of a size

/// A formula for the size as the mesher wants it.
struct LocalSize {
  Formula formula;
  double scale = 1.0;                                                        // [m]
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;  // of the formula in the solid

  /// The mesher may ask a little outside, where the formula need not make sense.
  double operator()(const Vec3& X) const { return scale * std::clamp(formula(0.0, X), 0.5 * smallest, 2.0 * largest); }
};

double positive_size(const Formula& formula, const Vec3& X, const Origin& origin) {
  const double h = formula(0.0, X);
  if (h > 0.0) return h;
  throw InputError(origin, fmt::format("size = \"{}\" gives {:g} at ({:g}, {:g}, {:g}) m; it must be positive "
                                       "everywhere in the solid",
                                       formula.text(), h, X.x, X.y, X.z));
}

/// Scaled so that as many particles fill the solid as with the same spacing everywhere: the mean of size^-3 is
/// spacing^-3.
LocalSize local_size(const Formula& formula, const Origin& origin, const TriangleSurface& surface, double spacing) {
  const SurfaceIndex index(surface);
  const Bounds box = bounds(surface);
  const Vec3 extent = box.size();
  const double step = std::max({extent.x, extent.y, extent.z}) / kSizeSamples;
  LocalSize size{formula};
  double inverse_cubes = 0.0;
  int samples = 0;
  for (double x = 0.5 * step; x < extent.x; x += step)
    for (double y = 0.5 * step; y < extent.y; y += step)
      for (double z = std::min(0.5 * step, 0.5 * extent.z); z < extent.z; z += step) {
        const Vec3 X = box.lower + Vec3{x, y, z};
        if (index.location(X) != Location::inside) continue;
        const double h = positive_size(formula, X, origin);
        size.smallest = std::min(size.smallest, h);
        size.largest = std::max(size.largest, h);
        inverse_cubes += 1.0 / (h * h * h);
        ++samples;
      }
  if (samples == 0)
    throw InputError(origin, "the solid is too thin to find the mean of the size in it; leave size out");
  size.scale = spacing * std::cbrt(inverse_cubes / samples);
  return size;
}

double spacing_of(const ParticleSpec& particles, double volume) {
  const auto refuse = [&](const std::string& found) {
    throw InputError(particles.origin,
                     fmt::format("found {}; a delaunay body in a shape that is not made of boxes or of one polygon is "
                                 "filled with tetrahedra by a mesher, which takes a spacing or a count alone",
                                 found));
  };
  if (std::holds_alternative<MeshFileSpec>(particles.source))
    throw InputError(particles.origin, "a mesh brings its own shape; leave body.shape out");
  const auto* lattice = std::get_if<LatticeSpec>(&particles.source);
  if (lattice == nullptr) refuse("points of another kind");
  if (lattice->counts) refuse("counts of a lattice");
  if (lattice->kind != LatticeKind::cubic) refuse("a lattice");
  if (lattice->jitter > 0.0) refuse("jitter");
  if (particles.radius) refuse("radii");
  return lattice->spacing ? *lattice->spacing : std::cbrt(volume / static_cast<double>(lattice->count.value()));
}

}  // namespace

TetrahedralMesh mesh_of_shape(const BodySpec& body, std::vector<std::string>& notes) {
  const ShapeSurface shape = shape_surface(*body.shape);
  const double inside = volume(shape.surface), spacing = spacing_of(body.particles, inside);
  require_room(body.particles, inside, bounds(shape.surface).size());
  SurfaceMeshSpec spec{.spacing = spacing, .mesher = body.particles.mesher.mesher.value_or(Mesher::automatic)};
  if (const std::optional<Formula>& size = body.particles.mesher.size)
    spec.size = local_size(*size, body.particles.origin, shape.surface, spacing);
  SurfaceMesh made = mesh_surface(shape.surface, spec);
  for (std::vector<std::string>& names : made.mesh.side_names) names = shape.names.at(names.front());
  notes.insert(notes.end(), shape.notes.begin(), shape.notes.end());
  notes.push_back(fmt::format(
      "mesh of body \"{}\" by {}: {} particles, {} tetrahedra in a surface of {} triangles; volume "
      "{:.6g} m3, {:+.2g}% of that inside the surface; smallest angle between faces {:.3g} "
      "degrees ({} tetrahedra below 10), smallest quality 3 r_in/r_out {:.3g}",
      body.name, made.mesher == Mesher::gmsh ? "gmsh" : "CGAL", made.mesh.points.size(), made.mesh.tetrahedra.size(),
      shape.surface.size(), made.volume, 100.0 * (made.volume / made.surface_volume - 1.0), made.smallest_angle,
      made.slivers, made.smallest_quality));
  return std::move(made.mesh);
}

}  // namespace tessera
