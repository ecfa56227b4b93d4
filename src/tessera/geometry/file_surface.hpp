#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tessera/geometry/file_place.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// What a surface file says, before anything about it is believed but that its indices are in range. Lengths are in
/// the file's unit.
struct FileSurface {
  std::string path;  // or another name by which errors call the surface
  PlaceUnit unit = PlaceUnit::line;
  TriangleSurface surface;
  std::vector<std::int64_t> place;  // of each triangle in the file, from one; of a split polygon, that of the polygon
};

/// "triangle 7 (line 12) at (0, 0.5, 1)": its number among the file's triangles, and its centre.
std::string describe_triangle(const FileSurface& file, Index triangle);

/// "(0, 0.5, 1)".
std::string describe_point(const Vec3& X);

}  // namespace tessera
