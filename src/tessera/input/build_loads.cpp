#include "tessera/input/build_parts.hpp"
#include "tessera/input/names.hpp"

namespace tessera::input {

namespace {

Condition build_condition(const std::string& name) {
  if (name == "fixed") return Condition::fixed;
  if (name == "symmetric") return Condition::symmetric;
  if (name == "antisymmetric") return Condition::antisymmetric;
  return Condition::free;
}

}  // namespace

BoundaryCondition build_boundary(const Reader& t, const std::vector<std::string>& bodies) {
  BoundaryCondition b;
  b.body = body_of(t, bodies);
  b.where = t.selection("where");
  b.origin = t.origin();
  if (t.has("condition")) b.kind = build_condition(t.text("condition"));
  if (t.has("displacement")) b.kind = PrescribedDisplacement{t.partial_formulas("displacement")};
  if (t.has("velocity")) b.kind = PrescribedVelocity{t.partial_formulas("velocity")};
  if (t.has("traction")) b.kind = NominalTraction{t.formulas("traction")};
  if (t.has("pressure")) b.kind = NominalPressure{t.formula("pressure")};
  return b;
}

}  // namespace tessera::input
