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

FormulaVec3 whole_displacement(const Reader& t) {
  FormulaVec3 result;
  if (!t.has("displacement")) return result;
  const PartialFormulaVec3 components = t.partial_formulas("displacement");
  for (std::size_t i = 0; i < 3; ++i) {
    if (!components[i])
      throw InputError(t.origin_of("displacement"),
                       "found \"free\" beside a rotation, which prescribes all components; write 0 for none");
    result[i] = *components[i];
  }
  return result;
}

PrescribedRotation build_rotation(const Reader& t, int dimension) {
  const Reader r = t.table("rotation");
  const Vec3 axis = r.vector("axis");
  if (norm(axis) == 0.0) throw InputError(r.origin_of("axis"), "found [0, 0, 0]; expected a direction");
  if (dimension == 2 && (axis.x != 0.0 || axis.y != 0.0))
    throw InputError(r.origin_of("axis"), "with method.dimension = 2 the axis is [0, 0, 1] or its opposite");
  return {normalized(axis), r.vector("point"), r.formula("angle"), whole_displacement(t)};
}

}  // namespace

BoundaryCondition build_boundary(const Reader& t, const std::vector<std::string>& bodies, int dimension) {
  BoundaryCondition b;
  b.body = body_of(t, bodies);
  b.where = t.selection("where");
  b.origin = t.origin();
  if (t.has("condition")) b.kind = build_condition(t.text("condition"));
  if (t.has("displacement")) b.kind = PrescribedDisplacement{t.partial_formulas("displacement")};
  if (t.has("rotation")) b.kind = build_rotation(t, dimension);
  if (t.has("velocity")) b.kind = PrescribedVelocity{t.partial_formulas("velocity")};
  if (t.has("normal_displacement")) b.kind = NormalDisplacement{t.formula("normal_displacement")};
  if (t.has("tangential_displacement")) b.kind = TangentialDisplacement{t.formulas("tangential_displacement")};
  if (t.has("traction")) b.kind = NominalTraction{t.formulas("traction", FormulaNames::face)};
  if (t.has("pressure")) b.kind = NominalPressure{t.formula("pressure", FormulaNames::face)};
  if (t.has("following_pressure")) b.kind = FollowingPressure{t.formula("following_pressure", FormulaNames::face)};
  if (t.has("stress")) b.kind = NominalStress{t.formula_rows("stress", FormulaNames::face)};
  return b;
}

}  // namespace tessera::input
