#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/formula.hpp"
#include "tessera/geometry/selection.hpp"

namespace tessera {

enum class FieldFormat { vtkhdf, vtu, csv };

/// How VTKHDF files hold numbers: by the quantity (Quantity::exactness), or all in double precision.
enum class FieldPrecision { mixed, full };

/// When field frames are written and what they hold. The first and the last state are always written.
struct FieldsSpec {
  FieldFormat format = FieldFormat::vtkhdf;
  FieldPrecision precision = FieldPrecision::mixed;
  std::optional<double> every;          // [s]; unset: first and last state only
  std::vector<std::string> quantities;  // names of the quantity table; empty: the default set
  bool cells = false;                   // also the cells of the tessellation, as polyhedra or tetrahedra (VTU)
  Origin origin;
};

struct HistorySpec {
  std::optional<double> every;  // [s]; unset: a hundredth of the end time
};

struct CheckpointSpec {
  std::optional<double> every_wall;  // wall-clock seconds between checkpoints
  std::optional<double> every_time;  // simulated seconds between checkpoints
};

struct OutputSpec {
  FieldsSpec fields;
  HistorySpec history;
  CheckpointSpec checkpoint;
};

enum class ProbeKind { reaction, point, average, maximum, momentum, energy };

/// One [[probe]] entry.
struct ProbeSpec {
  std::string name;
  ProbeKind kind = ProbeKind::reaction;
  std::string body;  // empty: the only body
  std::optional<SelectionSpec>
      where;               // reaction: boundary faces or particles; average, maximum: particles (unset: all)
  std::optional<Vec3> at;  // point: material position [m]
  Vec3 about;              // reaction: the point in space about which its torque is taken [m]
  std::string quantity;    // average, maximum: a name of the quantity table
  Origin origin;
};

/// One [[reference]] entry: errors of the displacement against formulas, in summary.json.
struct ReferenceSpec {
  std::string name;
  FormulaVec3 displacement;  // [m]
  Origin origin;
};

}  // namespace tessera
