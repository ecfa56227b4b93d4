#include <fmt/format.h>

#include "tessera/input/build_parts.hpp"
#include "tessera/input/names.hpp"

namespace tessera::input {

namespace {

Formula material_formula(const Reader& t, const std::string& key) {
  Formula formula = t.formula(key);
  if (formula.depends_on_time()) throw InputError(t.origin_of(key), "depends on t; expected a formula in X, Y, Z");
  return formula;
}

std::uint64_t seed_of(const Reader& t) { return static_cast<std::uint64_t>(t.integer("seed")); }

std::optional<Index> count_of(const Reader& t) {
  if (!t.has("count")) return std::nullopt;
  return static_cast<Index>(t.integer("count"));
}

LatticeSpec build_lattice(const Reader& t, int dimension) {
  LatticeSpec lattice;
  lattice.spacing = t.optional_number("spacing");
  if (t.has("counts")) {
    const Vec3 n = t.vector("counts");
    if (dimension == 2 && n.z != 1.0)
      throw InputError(t.origin_of("counts"),
                       fmt::format("found {} in z; expected 1, or two counts, with method.dimension = 2", n.z));
    lattice.counts = {static_cast<int>(n.x), static_cast<int>(n.y), static_cast<int>(n.z)};
  }
  lattice.jitter = t.number("jitter");
  lattice.seed = seed_of(t);
  const std::string kind = t.text("lattice");
  if (kind == "bcc") lattice.kind = LatticeKind::bcc;
  if (kind == "fcc") lattice.kind = LatticeKind::fcc;
  if (kind == "hcp") lattice.kind = LatticeKind::hcp;
  if (lattice.kind != LatticeKind::cubic && dimension == 2)
    throw InputError(t.origin_of("lattice"),
                     fmt::format("\"{}\" has no plane of its own; with method.dimension = 2 take \"cubic\", or "
                                 "arrangement = \"random\" or \"relaxed\"",
                                 kind));
  lattice.count = count_of(t);
  return lattice;
}

RelaxedSpec build_relaxed(const Reader& t) {
  RelaxedSpec relaxed;
  relaxed.amount = {count_of(t), t.optional_number("spacing")};
  relaxed.seed = seed_of(t);
  relaxed.iterations = static_cast<int>(t.integer("iterations"));
  relaxed.tolerance = t.number("tolerance");
  if (!t.has("size")) return relaxed;
  relaxed.size = material_formula(t, "size");
  return relaxed;
}

/// For tetrahedra in a surface; refused with all that is placed otherwise.
MesherSpec build_mesher(const Reader& t) {
  MesherSpec spec;
  if (t.has("mesher")) spec.mesher = t.text("mesher") == "gmsh" ? Mesher::gmsh : Mesher::cgal;
  if (t.has("size")) spec.size = material_formula(t, "size");
  return spec;
}

void refuse_beside(const Reader& t, const char* key, const std::string& arrangement) {
  if (t.has(key))
    throw InputError(t.origin_of(key),
                     fmt::format("has no effect with arrangement = \"{}\"; leave one of the two out", arrangement));
}

ParticleSpec build_particles(const Reader& t, const MethodSpec& method) {
  ParticleSpec particles;
  particles.origin = t.origin();
  particles.dimension = method.dimension;
  if (t.has("radius")) particles.radius = material_formula(t, "radius");
  if (t.has("file")) {
    particles.source = PointFileSpec{t.text("file")};
    particles.origin = t.origin_of("file");
  } else if (t.has("mesh")) {
    if (method.formulation != Formulation::delaunay)
      throw InputError(t.origin_of("mesh"),
                       "a mesh needs method.formulation = \"delaunay\"; voronoi takes a lattice or a file of points");
    particles.source = MeshFileSpec{t.text("mesh")};
    particles.origin = t.origin_of("mesh");
  } else if (t.text("arrangement") == "random") {
    for (const char* key : {"size", "mesher"}) refuse_beside(t, key, "random");
    particles.source = RandomSpec{{count_of(t), t.optional_number("spacing")}, seed_of(t)};
    particles.origin = t.origin_of("arrangement");
  } else if (t.text("arrangement") == "relaxed") {
    refuse_beside(t, "mesher", "relaxed");
    particles.source = build_relaxed(t);
    particles.origin = t.origin_of("arrangement");
  } else {
    particles.source = build_lattice(t, method.dimension);
    particles.mesher = build_mesher(t);
  }
  return particles;
}

}  // namespace

BodySpec build_body(const Reader& t, const std::vector<std::string>& materials, const MethodSpec& method) {
  BodySpec body;
  body.name = t.text("name");
  body.origin = t.origin();
  if (t.has("shape")) body.shape = build_shape(t.table("shape"));
  body.particles = build_particles(t.table("particles"), method);
  if (!body.shape && !std::holds_alternative<MeshFileSpec>(body.particles.source)) {
    Origin origin = t.origin();
    origin.key += ".shape";
    throw InputError(origin, "missing; expected a shape, as in { box = { min = [0, 0, 0], max = [1, 1, 1] } }");
  }
  body.material = static_cast<Index>(position_of(t, "material", materials, "material"));
  return body;
}

}  // namespace tessera::input
