#pragma once

#include <array>
#include <string>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/geometry/shape.hpp"

namespace tessera {

/// The rectilinear grid through all coordinates of a shape's boxes. Each grid cell is wholly inside or outside of
/// every part of the shape.
struct BoxGrid {
  std::array<std::vector<double>, 3> planes;  // ascending [m]

  int cells(int axis) const { return static_cast<int>(planes[static_cast<std::size_t>(axis)].size()) - 1; }
  std::size_t size() const;
  /// Number of the cell (i, j, k), each counted from zero.
  std::size_t cell(const std::array<int, 3>& c) const;
};

/// A part of a shape on the grid: the whole shape first, then its parts in the order written.
struct GridPart {
  std::string path;                     // how its faces are called: "NAME", "part2", "part2.part1"
  bool is_named = false;                // by the user
  std::vector<bool> inside;             // per grid cell
  std::array<int, 3> lower{}, upper{};  // first and last grid plane of what is inside
};

struct GriddedShape {
  BoxGrid grid;
  std::vector<GridPart> parts;  // parts[0] is the whole
};

/// Lays the grid of a shape that is made of boxes and finds what is inside. Throws InputError at the shape's origin for
/// empty boxes and shapes that leave nothing.
GriddedShape grid_shape(const Shape& shape);

/// Sorted values with those that are equal to within `tolerance` reduced to the smallest of them.
std::vector<double> merge_close(std::vector<double> values, double tolerance);

/// Position in ascending `planes` of the one nearest to `value`.
int nearest_plane(const std::vector<double>& planes, double value);

}  // namespace tessera
