#pragma once

#include <array>
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

/// Rotation about an axis, then a displacement: u = R (X - point) + point - X + displacement, R by `angle` [rad]
/// about `axis` in the right-handed sense.
struct PrescribedRotation {
  Vec3 axis;   // unit length
  Vec3 point;  // on the axis [m]
  Formula angle;
  FormulaVec3 displacement;  // [m]
};

/// Displacement along the reference normal, N . u [m]; the components in the face's plane are free.
struct NormalDisplacement {
  Formula value;
};

/// Displacement in the reference face's plane, (I - N (x) N) u, of which `components` give the vector u [m]; the
/// component along the normal is free.
struct TangentialDisplacement {
  FormulaVec3 components;
};

/// Force per reference area [Pa], fixed in direction.
struct NominalTraction {
  FormulaVec3 components;
};

/// Nominal traction -p N with the reference normal N [Pa].
struct NominalPressure {
  Formula pressure;
};

/// Nominal traction P N of a given first Piola-Kirchhoff stress [Pa], row by row.
struct NominalStress {
  std::array<FormulaVec3, 3> rows;
};

/// Pressure on the present face, against its present normal and per present area: the nominal traction -p J F^-T N
/// [Pa].
struct FollowingPressure {
  Formula pressure;
};

/// One [[boundary]] entry.
struct BoundaryCondition {
  std::string body;  // empty: the only body
  SelectionSpec where;
  std::variant<Condition, PrescribedDisplacement, PrescribedVelocity, PrescribedRotation, NormalDisplacement,
               TangentialDisplacement, NominalTraction, NominalPressure, NominalStress, FollowingPressure>
      kind;
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
