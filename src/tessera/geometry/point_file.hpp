#pragma once

#include <vector>

#include "tessera/geometry/particles.hpp"

namespace tessera {

struct FilePoints {
  std::vector<Vec3> points;  // [m]
  std::vector<int> lines;    // of the file, counted from one
};

/// Reads a CSV file with the columns x, y, z in any order; blank lines are skipped. Throws InputError with file, line
/// and column for unreadable files, missing or unknown columns and fields that are no finite number.
FilePoints read_points(const PointFileSpec& spec, const Origin& origin);

}  // namespace tessera
