#include "tessera/simulation/model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "tessera/simulation/body_builder.hpp"
#include "tessera/simulation/overlap.hpp"
#include "tessera/simulation/quality_survey.hpp"

namespace tessera {

namespace {

/// Initial displacement and velocity at a material point of a body; entries add up.
struct InitialMotion {
  std::vector<const InitialCondition*> entries;

  InitialMotion(const Case& c, const BodySpec& body) {
    for (const InitialCondition& i : c.initial)
      if (i.body.empty() || i.body == body.name) entries.push_back(&i);
  }
  Vec3 displacement(const Vec3& X) const {
    Vec3 u;
    for (const InitialCondition* e : entries) u += evaluate(e->displacement, 0.0, X);
    return u;
  }
  Vec3 velocity(const Vec3& X) const {
    Vec3 v;
    for (const InitialCondition* e : entries) v += evaluate(e->velocity, 0.0, X);
    return v;
  }
};

/// Points with prescribed motion and loaded sites, gathered over the bodies.
struct LoadParts {
  std::vector<Vec3> X, initial;
  std::vector<FaceSpread> spreads;
  std::vector<PointConstraint> constraints;
  std::vector<LoadedSite> sites;
};

void collect_motion(LoadParts& parts, const BuiltBody& b, const InitialMotion& initial) {
  const auto add = [&](const Vec3& X, const FaceSpread& face) {
    parts.X.push_back(X);
    parts.spreads.push_back(face);
    parts.initial.push_back(face.mean(X, [&](const Vec3& p) { return initial.displacement(p); }));
  };
  for (const BoundaryNode& f : b.d.nodes) add(f.wall, f.spread);
  for (const ParticleConstraint& c : b.d.constraints) add(b.d.X[static_cast<std::size_t>(c.particle)], {});
  parts.constraints.insert(parts.constraints.end(), b.constraints.begin(), b.constraints.end());
}

void collect_tractions(LoadParts& parts, const BuiltBody& b, Index first_site) {
  for (const LoadedPiece& l : b.loaded)
    for (Index k = 0; k < b.sites_per_piece; ++k) {
      const Mat3 free = identity() - b.pieces[static_cast<std::size_t>(l.piece)].D;
      parts.sites.push_back({first_site + b.sites_per_piece * l.piece + k, free, l.condition});
    }
}

void append_cells(std::optional<CellGeometry>& all, std::optional<CellGeometry> more, Index shift) {
  if (!more) return;
  if (auto* polyhedra = std::get_if<std::vector<Polyhedron>>(&*more)) {
    for (Polyhedron& p : *polyhedra) p.particle += shift;
    if (!all) all.emplace(std::vector<Polyhedron>{});
    auto& list = std::get<std::vector<Polyhedron>>(*all);
    list.insert(list.end(), polyhedra->begin(), polyhedra->end());
  } else {
    auto& tetrahedra = std::get<std::vector<std::array<Index, 4>>>(*more);
    for (auto& t : tetrahedra)
      for (Index& v : t) v += shift;
    if (!all) all.emplace(std::vector<std::array<Index, 4>>{});
    auto& list = std::get<std::vector<std::array<Index, 4>>>(*all);
    list.insert(list.end(), tetrahedra.begin(), tetrahedra.end());
  }
}

BodyModel place_body(const BuiltBody& b, const Discretization& before) {
  BodyModel m;
  m.name = b.surface.body;
  m.first = before.particles();
  m.last = m.first + b.d.particles();
  m.surface = b.surface;
  m.first_node = static_cast<Index>(before.nodes.size());
  for (const BoundaryNode& f : b.d.nodes) m.node_piece.push_back(f.site);
  m.first_constraint = static_cast<Index>(before.constraints.size());
  m.last_constraint = m.first_constraint + static_cast<Index>(b.d.constraints.size());
  return m;
}

/// In plane strain nothing varies across the plane. What counts is whether neighbours tell how F varies in both
/// directions of it; where they do not, the map to the points is singular there.
Index unresolved_in_plane(const CellGradients& gradients) {
  constexpr double singular = 1e-6;  // resolved directions differ by less than a thousand
  Index cells = 0;
  for (const Mat3& A : gradients.to_points) {
    const double determinant = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
    const double size = A(0, 0) * A(0, 0) + A(0, 1) * A(0, 1) + A(1, 0) * A(1, 0) + A(1, 1) * A(1, 1);
    if (!(std::abs(determinant) > singular * size)) ++cells;
  }
  return cells;
}

/// Cell integration falls back where neighbours do not tell how F varies.
void note_unresolved_cells(Model& model) {
  const auto& gradients = model.system.gradients;
  if (!gradients || gradients->unresolved == 0) return;
  model.notes.push_back(
      fmt::format("cell integration: {} of {} cells have neighbours in one plane or line only; across it F counts as "
                  "constant there, as with nodal integration",
                  gradients->unresolved, model.system.particles()));
}

}  // namespace

const BodyModel& Model::body(const std::string& name) const {
  if (name.empty()) return bodies.front();
  for (const BodyModel& b : bodies)
    if (b.name == name) return b;
  throw std::logic_error("no body is called " + name);  // the reader has checked the names
}

IntegrationSummary integration_of(const Model& model) {
  if (const auto& gradients = model.system.gradients) return {name_of(Integration::cell), gradients->unresolved};
  if (const auto& second = model.system.second_order)
    return {name_of(Integration::second_order), static_cast<std::int64_t>(second->unresolved.size())};
  return {name_of(Integration::nodal), 0};
}

Model build_model(const Case& c) {
  Model model;
  for (const BodySpec& spec : c.bodies) model.conditions.push_back(conditions_on(c, spec));
  std::vector<BuiltBody> bodies;
  for (std::size_t i = 0; i < c.bodies.size(); ++i) bodies.push_back(build_body(c, c.bodies[i], model.conditions[i]));
  refuse_overlap(c.bodies, bodies);

  QualitySurvey survey;
  for (const BuiltBody& b : bodies) survey.add(b);
  model.quality = survey.quality();
  Discretization all;
  LoadParts parts;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BuiltBody& b = bodies[i];
    const InitialMotion initial(c, c.bodies[i]);
    const Index shift = all.particles();
    for (Index u : b.user_number) model.user_number.push_back(u + shift);
    for (const Vec3& X : b.d.X) {
      model.initial_displacement.push_back(initial.displacement(X));
      model.initial_velocity.push_back(initial.velocity(X));
      model.body_of.push_back(static_cast<Index>(i));
      model.material_of.push_back(c.bodies[i].material);
    }
    collect_motion(parts, b, initial);
    collect_tractions(parts, b, static_cast<Index>(all.sites.size()));
    model.identities = worst_of(model.identities, b.identities);
    model.sides.insert(model.sides.end(), b.sides.begin(), b.sides.end());
    model.notes.insert(model.notes.end(), b.notes.begin(), b.notes.end());
    model.boundary_faces += static_cast<Index>(b.surface.pieces.size());
    append_cells(model.cells, std::move(b.cells), shift);
    model.bodies.push_back(place_body(b, all));
    append(all, std::move(b.d));
  }
  model.loads.motion = PrescribedMotion(parts.X, parts.constraints, parts.initial, parts.spreads);
  model.loads.tractions = Tractions(all, parts.sites);
  model.loads.gravity = c.gravity;
  model.system = make_system(std::move(all), c.materials, model.material_of, 0, c.method.volumetric);
  if (c.method.dimension == 2 && model.system.gradients)
    model.system.gradients->unresolved = unresolved_in_plane(*model.system.gradients);
  note_unresolved_cells(model);
  return model;
}

}  // namespace tessera
