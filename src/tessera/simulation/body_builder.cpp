#include "tessera/simulation/body_builder.hpp"

#include <fmt/format.h>

#include "tessera/simulation/delaunay_body.hpp"
#include "tessera/simulation/voronoi_body.hpp"

namespace tessera {

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

BuiltBody build(const Case& c, const BodySpec& body, const ConditionList& conditions) {
  const bool voronoi = c.method.formulation == Formulation::voronoi;
  if (voronoi && !body.shape) throw InputError(body.origin, "a voronoi body needs a shape");
  std::optional<Solid> solid;
  if (body.shape && has_convex_pieces(*body.shape)) solid = build_solid(*body.shape);
  if (voronoi || solid || !body.shape) refuse_wishes_without_mesher(body.particles);
  if (voronoi && !solid) return build_voronoi_in_surface(c, body, conditions);
  BuiltBody b = voronoi ? build_voronoi(c, body, *solid, conditions) : build_delaunay(c, body, solid, conditions);
  b.solid = std::move(solid);
  return b;
}

/// The same error with the body's name, where the message does not have it.
GeometryError with_body(const GeometryError& error, const std::string& body) {
  const std::string message = error.what(), name = fmt::format("body \"{}\"", body);
  return message.find(name) == std::string::npos ? GeometryError(fmt::format("{} ({})", message, name)) : error;
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

BuiltBody build_body(const Case& c, const BodySpec& body, const std::vector<BoundaryCondition>& conditions) {
  ConditionList list;
  for (const BoundaryCondition& condition : conditions) list.push_back(&condition);
  try {
    return build(c, body, list);
  } catch (const GeometryError& error) {
    throw with_body(error, body.name);
  }
}

}  // namespace tessera
