#include "tessera/simulation/delaunay_body.hpp"

#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/delaunay.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/geometry/file_place.hpp"
#include "tessera/geometry/surface_sides.hpp"
#include "tessera/simulation/body_points.hpp"
#include "tessera/simulation/body_surface.hpp"
#include "tessera/simulation/meshed_body.hpp"
#include "tessera/simulation/radii.hpp"

namespace tessera {

namespace {

/// Renumbers a mesh's vertices along the space-filling curve.
std::vector<Index> reorder(TetrahedralMesh& mesh) {
  const std::vector<Index> order = hilbert_order(mesh.points);
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[static_cast<std::size_t>(order[i])] = static_cast<Index>(i);
  mesh.points = permuted(mesh.points, order);
  for (auto& t : mesh.tetrahedra)
    for (Index& v : t) v = place[static_cast<std::size_t>(v)];
  for (BoundaryTriangle& t : mesh.boundary)
    for (Index& v : t.vertices) v = place[static_cast<std::size_t>(v)];
  return order;
}

PointSet vertices_of(const Case& c, const BodySpec& body, const Solid& solid) {
  PointSet vertices = points_of(c, body, solid);
  set_radii(c.method, body.particles, vertices);
  return vertices;
}

double volume_of(const TetrahedralMesh& mesh) {
  double six_volumes = 0.0;
  for (const auto& t : mesh.tetrahedra) {
    const Vec3& x = mesh.points[static_cast<std::size_t>(t[0])];
    const auto edge = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])] - x; };
    six_volumes += dot(edge(1), cross(edge(2), edge(3)));
  }
  return six_volumes / 6.0;
}

TetrahedralMesh mesh_of(const Case& c, const BodySpec& body, const std::optional<Solid>& solid,
                        std::vector<std::string>& notes) {
  const bool is_surface = body.shape && !solid;
  if (is_surface && c.method.dimension != 3)
    throw InputError(body.shape->origin,
                     "a shape that is not made of boxes or of one polygon needs method.dimension = 3");
  if (is_surface && c.method.tetrahedra == Tetrahedralization::split)
    throw InputError(
        body.shape->origin,
        "method.tetrahedra = \"split\" splits lattices in boxes and polygons; any other shape is filled by a "
        "mesher");
  if (is_surface) return mesh_of_shape(body, notes);
  if (const auto* file = std::get_if<MeshFileSpec>(&body.particles.source)) {
    require_file(file->path, body.particles.origin);
    return read_mesh(file->path);
  }
  return tetrahedralize(vertices_of(c, body, *solid), *solid, c.method.tetrahedra);
}

}  // namespace

BuiltBody build_delaunay(const Case& c, const BodySpec& body, const std::optional<Solid>& solid,
                         const ConditionList& conditions) {
  BuiltBody b;
  TetrahedralMesh mesh = mesh_of(c, body, solid, b.notes);
  if (c.output.fields.cells) b.cells = mesh.tetrahedra;
  b.user_number = reorder(mesh);
  b.surface = surface_of_body(body, mesh);
  b.outline = outline_of(mesh);
  b.sides = side_rows(b.surface, summarize_sides(*b.outline));
  b.pieces.resize(b.surface.pieces.size());
  b.sites_per_piece = 3;

  const std::vector<PointConstraint> particles = constrain_particles(b.surface, mesh.points, conditions, c.time.end);
  b.loaded = load_pieces(b.surface, conditions);
  std::vector<ParticleConstraint> constraints;
  for (std::size_t a = 0; a < particles.size(); ++a) {
    if (is_zero(particles[a].D)) continue;
    constraints.push_back({static_cast<Index>(a), particles[a].D});
    b.constraints.push_back(particles[a]);
  }
  b.d = discretize_delaunay(mesh, constraints);
  if (c.method.integration == Integration::cell) b.d.measure = measure_of_dual_cells(mesh);
  b.identities = identities_of_delaunay(b.d, solid ? solid->volume : volume_of(mesh));
  return b;
}

}  // namespace tessera
