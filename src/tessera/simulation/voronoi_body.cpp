#include "tessera/simulation/voronoi_body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/moved_means.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/geometry/shape_surface.hpp"
#include "tessera/geometry/solid_surface.hpp"
#include "tessera/geometry/surface_sides.hpp"
#include "tessera/loads/condition_values.hpp"
#include "tessera/simulation/body_points.hpp"
#include "tessera/simulation/body_surface.hpp"
#include "tessera/simulation/radii.hpp"
#include "tessera/simulation/relaxed_points.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera {

namespace {

Discretization discretize(const MethodSpec& method, const Generators& X, const Cells& cells,
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
      "particles around them do not determine second derivatives (fewer than four layers in some direction, hardly "
      "more than a dozen particles around, as at a tip, or several faces with one neighbour)",
      body, unresolved, resolved.size());
}

/// Constraints, loads and bonds of a body whose surface is known.
void discretize_cells(const Case& c, const BodyCells& made, const ConditionList& conditions, BuiltBody& b) {
  b.pieces = constrain_faces(b.surface, conditions);
  b.loaded = load_pieces(b.surface, conditions);
  std::vector<Mat3> D;
  for (const PointConstraint& p : b.pieces) D.push_back(p.D);
  b.d = discretize(c.method, {made.X, {}, b.user_number}, made.cells, D);
  if (c.method.integration == Integration::cell) b.d.measure = measure_of_cells(made.cells);
  if (b.d.measure && c.method.boundary == BoundaryTreatment::variational)
    b.d.measure->moved = moved_means(b.d, made.cells);
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

/// What cannot be done yet with solids that a surface encloses.
void check_surface_case(const Case& c, const Shape& shape) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(shape.origin, "a shape that is not made of boxes or of one polygon " + what);
  };
  if (c.method.boundary != BoundaryTreatment::consistent)
    refuse("needs method.boundary = \"consistent\": the others want cells whose faces all bisect");
  if (c.method.dimension != 3) refuse("needs method.dimension = 3");
}

}  // namespace

BuiltBody build_voronoi(const Case& c, const BodySpec& body, const Solid& solid, const ConditionList& conditions) {
  BuiltBody b;
  PointSet given = points_of(c, body, solid);
  relax_points(body, solid, given.points, b.notes);
  set_radii(c.method, body.particles, given);
  b.user_number = hilbert_order(given.points);
  BodyCells made{permuted(given.points, b.user_number), {}, solid.volume};
  const std::vector<double> weights = power_weights(given, b.user_number);
  made.cells = voronoi_cells({made.X, weights, b.user_number}, solid, moments_for(c.method));
  b.surface = surface_of_body(body, solid, made.cells);
  b.sides = side_rows(b.surface, summarize_sides(solid));
  discretize_cells(c, made, conditions, b);
  if (c.output.fields.cells)
    b.cells = in_users_numbers(voronoi_polyhedra({made.X, weights, b.user_number}, solid), b.user_number);
  return b;
}

BuiltBody build_voronoi_in_surface(const Case& c, const BodySpec& body, const ConditionList& conditions) {
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
  b.surface = surface_of_body(body, shape, made.cells);
  b.sides = side_rows(b.surface, summarize_sides(shape.surface));
  if (c.output.fields.cells) b.cells = in_users_numbers(std::move(found.polyhedra), b.user_number);
  discretize_cells(c, made, conditions, b);
  b.outline = std::move(shape.surface);
  return b;
}

}  // namespace tessera
