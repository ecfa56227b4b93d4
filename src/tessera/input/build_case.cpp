#include "tessera/input/build_case.hpp"

#include <fmt/format.h>

#include "tessera/base/text.hpp"
#include "tessera/input/build_parts.hpp"
#include "tessera/input/material_models.hpp"
#include "tessera/input/names.hpp"

namespace tessera::input {

namespace {

MethodSpec build_method(const Reader& t) {
  MethodSpec method;
  method.formulation = t.text("formulation") == "delaunay" ? Formulation::delaunay : Formulation::voronoi;
  const std::string boundary = t.text_or_empty("boundary");
  if (boundary == "variational") method.boundary = BoundaryTreatment::variational;
  if (boundary == "quasi-static") method.boundary = BoundaryTreatment::quasi_static;
  if (t.text("integration") == "cell") method.integration = Integration::cell;
  if (method.integration == Integration::cell && method.boundary == BoundaryTreatment::quasi_static)
    throw InputError(
        t.origin_of("integration"),
        "found \"cell\" with boundary = \"quasi-static\", whose forces derive from no energy that could be "
        "integrated; take boundary = \"consistent\" or \"variational\", or integration = \"nodal\"");
  if (t.text("integration") == "second-order") {
    method.integration = Integration::second_order;
    if (method.formulation != Formulation::voronoi || method.boundary != BoundaryTreatment::consistent)
      throw InputError(
          t.origin_of("integration"),
          "found \"second-order\"; it needs formulation = \"voronoi\" and boundary = \"consistent\", whose "
          "faces have one position each; the others have \"nodal\" and \"cell\"");
  }
  const std::string tetrahedra = t.text_or_empty("tetrahedra");
  if (tetrahedra == "delaunay") method.tetrahedra = Tetrahedralization::delaunay;
  if (tetrahedra == "split") method.tetrahedra = Tetrahedralization::split;
  if (t.text("volumetric") == "averaged") method.volumetric = Volumetric::averaged;
  method.dimension = static_cast<int>(t.integer("dimension"));
  return method;
}

Material build_material(const Reader& t) {
  Material m;
  m.name = t.text("name");
  m.model = t.text("model");
  m.density = t.number("density");
  m.contact = {t.table("contact").number("normal"), t.table("contact").number("tangential")};
  m.viscosity = {t.table("viscosity").number("linear"), t.table("viscosity").number("quadratic")};
  m.origin = t.origin();
  for (const MaterialModel& model : material_models())
    if (m.model == model.name) model.set_law(m, t);
  return m;
}

TimeSpec build_time(const Reader& t) {
  TimeSpec time;
  time.end = t.number("end");
  if (t.value("step").get_if<std::string>() == nullptr) {
    time.step = FixedStep{t.number("step"), t.flag("force")};
  } else if (t.text("step") == "auto-spectral") {
    time.step = AutoSpectralStep{};
  }
  time.safety = t.optional_number("safety").value_or(time.safety);
  if (const auto step = t.optional_number("mass_scaling")) time.mass_scaling = {*step, t.origin_of("mass_scaling")};
  time.damping = t.number("damping");
  time.origin = t.origin_of("step");
  return time;
}

}  // namespace

Case build_case(const Table& root) {
  const Reader top(root, {});
  Case c;
  c.title = top.text("title");
  c.method = build_method(top.table("method"));
  const auto material_names = unique_names(top.tables("material"), "material");
  for (const Reader& t : top.tables("material")) c.materials.push_back(build_material(t));
  const auto bodies = unique_names(top.tables("body"), "body");
  for (const Reader& t : top.tables("body")) c.bodies.push_back(build_body(t, material_names, c.method));
  for (const Reader& t : top.tables("initial"))
    c.initial.push_back({body_of(t, bodies), t.formulas("displacement"), t.formulas("velocity"), t.origin()});
  for (const Reader& t : top.tables("boundary")) c.boundary.push_back(build_boundary(t, bodies, c.method.dimension));
  c.gravity = top.table("gravity").vector("acceleration");
  c.time = build_time(top.table("time"));
  c.output = build_output(top.table("output"));
  unique_names(top.tables("probe"), "probe");
  for (const Reader& t : top.tables("probe")) c.probes.push_back(build_probe(t, bodies));
  unique_names(top.tables("reference"), "reference");
  for (const Reader& t : top.tables("reference"))
    c.references.push_back({t.text("name"), t.formulas("displacement"), t.origin()});
  return c;
}

}  // namespace tessera::input
