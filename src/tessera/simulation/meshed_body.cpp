#include "tessera/simulation/meshed_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tessera/geometry/shape_surface.hpp"
#include "tessera/tessellation/surface_mesh.hpp"

namespace tessera {

namespace {

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
  const double spacing = spacing_of(body.particles, volume(shape.surface));
  SurfaceMesh made = mesh_surface(shape.surface, {spacing});
  for (std::vector<std::string>& names : made.mesh.side_names) names = shape.names.at(names.front());
  notes.insert(notes.end(), shape.notes.begin(), shape.notes.end());
  notes.push_back(fmt::format(
      "mesh of body \"{}\": {} particles, {} tetrahedra in a surface of {} triangles; volume "
      "{:.6g} m3, {:+.2g}% of that inside the surface; smallest angle between faces {:.3g} "
      "degrees ({} tetrahedra below 10), smallest quality 3 r_in/r_out {:.3g}",
      body.name, made.mesh.points.size(), made.mesh.tetrahedra.size(), shape.surface.size(), made.volume,
      100.0 * (made.volume / made.surface_volume - 1.0), made.smallest_angle, made.slivers, made.smallest_quality));
  return std::move(made.mesh);
}

}  // namespace tessera
