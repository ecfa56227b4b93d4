#pragma once

#include <functional>

#include "tessera/output/output_spec.hpp"
#include "tessera/output/snapshot.hpp"

namespace tessera {

/// What the L2 error is measured by.
enum class ErrorMeasure { relative, absolute };

/// Distance of the displacements u_a from a reference u(X_a), volumes V_a as weights.
struct DisplacementError {
  double l2 = 0.0;   // relative: sqrt(sum V |u - u_ref|^2 / sum V |u_ref|^2) [-]; absolute: over sum V instead [m]
  double max = 0.0;  // largest |u - u_ref| [m]
  ErrorMeasure measure = ErrorMeasure::relative;  // absolute when the reference is zero at every particle
};

/// The error against `reference`, a function of the material position.
DisplacementError displacement_error(const Snapshot& snapshot, const std::function<Vec3(const Vec3&)>& reference);

/// The error against the formulas of a [[reference]] at the snapshot's time.
DisplacementError displacement_error(const Snapshot& snapshot, const ReferenceSpec& reference);

}  // namespace tessera
