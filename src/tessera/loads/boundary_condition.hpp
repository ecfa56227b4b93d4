#pragma once

#include <optional>
#include <string>
#include <variant>

#include "tessera/base/error.hpp"
#include "tessera/base/formula.hpp"
#include "tessera/geometry/selection.hpp"

namespace tessera {

/// Conditions without numbers, [V 14]: no motion at all; none along the normal; none in the face's plane.
enum class Condition { fixed, symmetric, antisymmetric, free };

/// Displacement of the boundary, component by component [m].
struct PrescribedDisplacement {
  PartialFormulaVec3 components;
};

/// Velocity of the boundary, component by component [m/s]; integrated from the initial displacement.
struct PrescribedVelocity {
  PartialFormulaVec3 components;
};

/// Force per reference area [Pa], fixed in direction.
struct NominalTraction {
  FormulaVec3 components;
};

/// Nominal traction -p N with the reference normal N [Pa].
struct NominalPressure {
  Formula pressure;
};

/// One [[boundary]] entry.
struct BoundaryCondition {
  std::string body;  // empty: the only body
  SelectionSpec where;
  std::variant<Condition, PrescribedDisplacement, PrescribedVelocity, NominalTraction, NominalPressure> kind;
  Origin origin;
};

/// One [[initial]] entry.
struct InitialCondition {
  std::string body;  // empty: the only body
  FormulaVec3 displacement;
  FormulaVec3 velocity;
  Origin origin;
};

}  // namespace tessera
