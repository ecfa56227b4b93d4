#pragma once

#include <vector>

#include "tessera/geometry/particles.hpp"

namespace tessera {

struct FilePoints {
  std::vector<Vec3> points;    // [m]
  std::vector<int> lines;      // of the file, counted from one
  std::vector<double> radius;  // [m]; empty when the file has no such column
};

/// Reads a CSV file with the columns x, y, z and, if there is one, radius, in any order; blank lines are skipped.
/// Throws InputError with file, line and column for unreadable files, missing or unknown columns, fields that are no
/// finite number and negative radii.
FilePoints read_points(const PointFileSpec& spec, const Origin& origin);

}  // namespace tessera
