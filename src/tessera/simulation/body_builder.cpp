#include "tessera/simulation/body_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/delaunay.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/geometry/shape_surface.hpp"
#include "tessera/geometry/solid_surface.hpp"
#include "tessera/geometry/surface_sides.hpp"
#include "tessera/loads/condition_values.hpp"
#include "tessera/simulation/meshed_body.hpp"
#include "tessera/simulation/radii.hpp"
#include "tessera/simulation/relaxed_points.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera {

namespace {

std::vector<const BoundaryCondition*> pointers(const std::vector<BoundaryCondition>& conditions) {
  std::vector<const BoundaryCondition*> list;
  for (const BoundaryCondition& c : conditions) list.push_back(&c);
  return list;
}

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

PointSet points_of(const Case& c, const BodySpec& body, const Solid& solid) {
  const Placement placement =
      c.method.formulation == Formulation::delaunay ? Placement::vertices : Placement::cell_centres;
  if (c.method.dimension == 3) return place_particles(body.particles, solid, placement);
  PointSet points = place_particles(in_plane(body, solid, placement), solid, placement);
  if (placement == Placement::cell_centres)
    for (Vec3& X : points.points) X.z = 0.5 * (solid.lower.z + solid.upper.z);
  return points;
}

std::vector<std::string> sorted_names(const std::vector<std::vector<std::string>>& sides) {
  std::set<std::string> names;
  for (const auto& side : sides) names.insert(side.begin(), side.end());
  return {names.begin(), names.end()};
}

Surface voronoi_surface(const BodySpec& body, const Solid& solid, const Cells& cells) {
  Surface s;
  s.body = body.name;
  s.lower = solid.lower;
  s.upper = solid.upper;
  for (const Side& side : solid.sides) s.side_names.push_back(side.names);
  s.known_names = side_names(solid);
  for (const BoundaryFace& f : cells.boundary) s.pieces.push_back({f.centroid, normalized(f.area), f.side, {}});
  return s;
}

Surface delaunay_surface(const BodySpec& body, const TetrahedralMesh& mesh) {
  Surface s;
  s.body = body.name;
  s.side_names = mesh.side_names;
  s.known_names = sorted_names(mesh.side_names);
  s.lower = s.upper = mesh.points.front();
  for (const Vec3& X : mesh.points)
    for (int i = 0; i < 3; ++i) {
      s.lower[i] = std::min(s.lower[i], X[i]);
      s.upper[i] = std::max(s.upper[i], X[i]);
    }
  for (const BoundaryTriangle& t : mesh.boundary) {
    const Vec3 &a = mesh.points[static_cast<std::size_t>(t.vertices[0])],
               &b = mesh.points[static_cast<std::size_t>(t.vertices[1])],
               &c = mesh.points[static_cast<std::size_t>(t.vertices[2])];
    s.pieces.push_back({(1.0 / 3.0) * (a + b + c),
                        normalized(cross(b - a, c - a)),
                        t.side,
                        {t.vertices[0], t.vertices[1], t.vertices[2]}});
  }
  return s;
}

TriangleSurface outline_of(const TetrahedralMesh& mesh) {
  TriangleSurface surface{mesh.points, {}, {}, {}};
  for (const auto& names : mesh.side_names) surface.side_names.push_back(names[0]);
  for (const BoundaryTriangle& t : mesh.boundary) {
    surface.triangles.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
    surface.side.push_back(t.side);
  }
  return surface;
}

Discretization discretize(const MethodSpec& method, std::span<const Vec3> X, const Cells& cells,
                          const std::vector<Mat3>& D) {
  switch (method.boundary) {
    case BoundaryTreatment::variational:
      return discretize_ghosts(X, cells, D, GhostForce::variational);
    case BoundaryTreatment::quasi_static:
      return discretize_ghosts(X, cells, D, GhostForce::quasi_static);
    case BoundaryTreatment::consistent:
      break;
  }
  return discretize_consistent(
      X, cells, D, method.integration == Integration::second_order ? FaceOrder::quadratic : FaceOrder::linear);
}

/// What the integration over cells has to know of them.
Moments moments_for(const MethodSpec& method) {
  switch (method.integration) {
    case Integration::nodal:
      return Moments::first;
    case Integration::cell:
      return Moments::second_of_cells;
    case Integration::second_order:
      break;
  }
  return Moments::second_of_faces;
}

/// A traction along a component whose motion is prescribed would have no effect; a pressure that follows turns into
/// any direction.
void refuse_loads_on_held_components(const BuiltBody& b, double end) {
  for (const LoadedPiece& l : b.loaded) {
    const auto i = static_cast<std::size_t>(l.piece);
    const Mat3& D = b.pieces[i].D;
    if (is_zero(D)) continue;
    const SurfacePiece& piece = b.surface.pieces[i];
    for (const double t : {0.0, 0.37 * end, end}) {
      const Vec3 T = TractionValues(*l.condition, t).at(piece.centroid, piece.N);
      const bool turns = std::holds_alternative<FollowingPressure>(l.condition->kind);
      if (turns || norm(D * T) > 1e-9 * norm(T))
        throw InputError(
            l.condition->origin,
            fmt::format(
                "loads a component of the boundary face at ({:g}, {:g}, {:g}) whose motion the [[boundary]] entry "
                "at line {} prescribes, so it would have no effect; take the face out of one of the two",
                piece.centroid.x, piece.centroid.y, piece.centroid.z,
                b.pieces[i].parts.front().condition->origin.line));
    }
  }
}

/// Points of a body along the space-filling curve, and their cells.
struct BodyCells {
  std::vector<Vec3> X;
  Cells cells;
  double solid_volume = 0.0;  // [m3]
};

/// Empty where every cell has second derivatives.
std::string describe_unresolved(const std::string& body, const std::vector<char>& resolved) {
  const auto unresolved = std::count(resolved.begin(), resolved.end(), 0);
  if (unresolved == 0) return {};
  return fmt::format(
      "second-order integration of body \"{}\": {} of {} cells take integration = \"cell\" and linear faces, for the "
      "particles around them do not determine second derivatives (fewer than three layers in some direction, or "
      "several "
      "faces with one neighbour)",
      body, unresolved, resolved.size());
}

/// Constraints, loads and bonds of a body whose surface is known.
void discretize_cells(const Case& c, const BodyCells& made, const std::vector<BoundaryCondition>& conditions,
                      BuiltBody& b) {
  b.pieces = constrain_faces(b.surface, pointers(conditions));
  b.loaded = load_pieces(b.surface, pointers(conditions));
  std::vector<Mat3> D;
  for (const PointConstraint& p : b.pieces) D.push_back(p.D);
  b.d = discretize(c.method, made.X, made.cells, D);
  if (c.method.integration == Integration::cell) b.d.measure = measure_of_cells(made.cells);
  if (b.d.second_order)
    if (std::string note = describe_unresolved(b.surface.body, b.d.second_order->derivatives.resolved); !note.empty())
      b.notes.push_back(std::move(note));
  for (const BoundaryNode& f : b.d.nodes) b.constraints.push_back(b.pieces[static_cast<std::size_t>(f.site)]);
  b.identities = identities_of_voronoi(b.d, made.cells, made.solid_volume);
  refuse_loads_on_held_components(b, c.time.end);
}

std::vector<Polyhedron> in_users_numbers(std::vector<Polyhedron> cells, const std::vector<Index>& user_number) {
  for (Polyhedron& cell : cells) cell.particle = user_number[static_cast<std::size_t>(cell.particle)];
  return cells;
}

BuiltBody build_voronoi(const Case& c, const BodySpec& body, const Solid& solid,
                        const std::vector<BoundaryCondition>& conditions) {
  BuiltBody b;
  PointSet given = points_of(c, body, solid);
  relax_points(body, solid, given.points, b.notes);
  set_radii(c.method, body.particles, given);
  b.user_number = hilbert_order(given.points);
  BodyCells made{permuted(given.points, b.user_number), {}, solid.volume};
  const std::vector<double> weights = power_weights(given, b.user_number);
  made.cells = voronoi_cells({made.X, weights, b.user_number}, solid, moments_for(c.method));
  b.surface = voronoi_surface(body, solid, made.cells);
  b.sides = side_rows(b.surface, summarize_sides(solid));
  discretize_cells(c, made, conditions, b);
  if (c.output.fields.cells)
    b.cells = in_users_numbers(voronoi_polyhedra({made.X, weights, b.user_number}, solid), b.user_number);
  return b;
}

/// What cannot be done yet with solids that a surface encloses.
void check_surface_case(const Case& c, const Shape& shape) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(shape.origin, "a shape that is not made of boxes or of one polygon " + what);
  };
  if (c.method.boundary != BoundaryTreatment::consistent)
    refuse("needs method.boundary = \"consistent\": the others want cells whose faces all bisect");
  if (c.method.dimension != 3) refuse("needs method.dimension = 3");
}

Surface surface_of_triangles(const BodySpec& body, const ShapeSurface& shape, const Cells& cells) {
  Surface s;
  s.body = body.name;
  const Bounds box = bounds(shape.surface);
  s.lower = box.lower;
  s.upper = box.upper;
  for (const std::string& side : shape.surface.side_names) s.side_names.push_back(shape.names.at(side));
  s.known_names = sorted_names(s.side_names);
  for (const BoundaryFace& f : cells.boundary) s.pieces.push_back({f.centroid, normalized(f.area), f.side, {}});
  return s;
}

BuiltBody build_in_surface(const Case& c, const BodySpec& body, const std::vector<BoundaryCondition>& conditions) {
  check_surface_case(c, *body.shape);
  ShapeSurface shape = shape_surface(*body.shape);
  const SurfaceIndex index(shape.surface);
  BuiltBody b;
  PointSet given = place_particles(body.particles, index);
  relax_points(body, index, given.points, b.notes);
  set_radii(c.method, body.particles, given);
  b.user_number = hilbert_order(given.points);
  BodyCells made{permuted(given.points, b.user_number), {}, volume(shape.surface)};
  const std::vector<double> weights = power_weights(given, b.user_number);
  SurfaceCells found = surface_cells({made.X, weights, b.user_number}, index, moments_for(c.method),
                                     c.output.fields.cells ? Pictures::wanted : Pictures::omitted);
  made.cells = std::move(found.cells);
  b.notes.push_back(fmt::format("surface of body \"{}\": {} triangles, {} vertices", body.name, shape.surface.size(),
                                shape.surface.vertices.size()));
  b.notes.insert(b.notes.end(), shape.notes.begin(), shape.notes.end());
  if (found.adopted > 0)
    b.notes.push_back(
        fmt::format("  {} parts of cells, {:.3g} m3, are cut off from their particles and went to "
                    "neighbouring cells",
                    found.adopted, found.adopted_volume));
  b.surface = surface_of_triangles(body, shape, made.cells);
  b.sides = side_rows(b.surface, summarize_sides(shape.surface));
  if (c.output.fields.cells) b.cells = in_users_numbers(std::move(found.polyhedra), b.user_number);
  discretize_cells(c, made, conditions, b);
  b.outline = std::move(shape.surface);
  return b;
}

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
  if (const auto* file = std::get_if<MeshFileSpec>(&body.particles.source)) return read_mesh(file->path);
  return tetrahedralize(vertices_of(c, body, *solid), *solid, c.method.tetrahedra);
}

BuiltBody build_delaunay(const Case& c, const BodySpec& body, const std::optional<Solid>& solid,
                         const std::vector<BoundaryCondition>& conditions) {
  BuiltBody b;
  TetrahedralMesh mesh = mesh_of(c, body, solid, b.notes);
  if (c.output.fields.cells) b.cells = mesh.tetrahedra;
  b.user_number = reorder(mesh);
  b.surface = delaunay_surface(body, mesh);
  b.outline = outline_of(mesh);
  b.sides = side_rows(b.surface, summarize_sides(*b.outline));
  b.pieces.resize(b.surface.pieces.size());
  b.sites_per_piece = 3;

  const std::vector<PointConstraint> particles =
      constrain_particles(b.surface, mesh.points, pointers(conditions), c.time.end);
  b.loaded = load_pieces(b.surface, pointers(conditions));
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

}  // namespace

std::vector<BoundaryCondition> conditions_on(const Case& c, const BodySpec& body) {
  std::vector<BoundaryCondition> conditions;
  for (const BoundaryCondition& condition : c.boundary)
    if (condition.body.empty() || condition.body == body.name) conditions.push_back(condition);
  if (c.method.dimension == 2) {
    BoundaryCondition slab;
    slab.body = body.name;
    slab.origin = slab.where.origin = body.origin;
    slab.where.items = {"-z", "+z"};
    slab.kind = Condition::symmetric;
    conditions.push_back(slab);
  }
  return conditions;
}

namespace {

void refuse_wishes_without_mesher(const ParticleSpec& particles) {
  const auto refuse = [&](const char* key) {
    throw InputError(
        particles.origin,
        fmt::format("{} is for the mesher, which fills delaunay bodies in shapes that are not made of boxes "
                    "or of one polygon; leave it out",
                    key));
  };
  if (particles.mesher.mesher) refuse("mesher");
  if (particles.mesher.size) refuse("size without arrangement = \"relaxed\"");
}

}  // namespace

BuiltBody build_body(const Case& c, const BodySpec& body, const std::vector<BoundaryCondition>& conditions) {
  const bool voronoi = c.method.formulation == Formulation::voronoi;
  if (voronoi && !body.shape) throw InputError(body.origin, "a voronoi body needs a shape");
  std::optional<Solid> solid;
  if (body.shape && has_convex_pieces(*body.shape)) solid = build_solid(*body.shape);
  if (voronoi || solid || !body.shape) refuse_wishes_without_mesher(body.particles);
  if (voronoi && !solid) return build_in_surface(c, body, conditions);
  BuiltBody b = voronoi ? build_voronoi(c, body, *solid, conditions) : build_delaunay(c, body, solid, conditions);
  b.solid = std::move(solid);
  return b;
}

}  // namespace tessera
