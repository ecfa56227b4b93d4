#include "tessera/tessellation/vtu.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "tessera/tessellation/vtu_data.hpp"

namespace tessera {
namespace {

/// The cells' connectivity as VTK stores it.
struct CellArrays {
  std::vector<std::int64_t> connectivity, offsets, types;
  std::size_t line = 0;  // of the connectivity
};

constexpr std::int64_t vtk_triangle = 5;  // and below it vertices and lines
constexpr std::int64_t vtk_tetrahedron = 10;

std::size_t count_of(const VtuLayout& layout, std::string_view name) {
  const std::string_view text = attribute(layout.piece, name);
  std::int64_t count = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || stop != text.data() + text.size() || count < 0 ||
      count > std::numeric_limits<Index>::max())
    layout.fail(layout.piece_line, fmt::format("{} is no count (0 to 2147483647)", name));
  return static_cast<std::size_t>(count);
}

const VtuArray& array_of(const VtuLayout& layout, std::string_view parent, std::string_view name) {
  for (const VtuArray& array : layout.arrays)
    if (array.parent == parent && (name.empty() || attribute(array.attributes, "Name") == name)) return array;
  layout.fail(layout.piece_line, fmt::format("<{}> has no array {}: write the grid again", parent, name));
}

void require_size(const VtuLayout& layout, const VtuArray& array, std::size_t found, std::size_t expected) {
  if (found != expected)
    layout.fail(array.line,
                fmt::format("the array holds {} values instead of {}: the file is truncated or damaged; write it again",
                            found, expected));
}

std::vector<Vec3> read_points(const VtuLayout& layout) {
  const VtuArray& array = array_of(layout, "Points", "");
  const std::vector<double> values = vtu_doubles(layout, array);
  const std::size_t count = count_of(layout, "NumberOfPoints");
  require_size(layout, array, values.size(), 3 * count);
  std::vector<Vec3> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return points;
}

std::vector<std::int64_t> read_cell_array(const VtuLayout& layout, std::string_view name, std::size_t expected) {
  const VtuArray& array = array_of(layout, "Cells", name);
  std::vector<std::int64_t> values = vtu_integers(layout, array);
  require_size(layout, array, values.size(), expected);
  return values;
}

CellArrays read_cells(const VtuLayout& layout) {
  const std::size_t count = count_of(layout, "NumberOfCells");
  CellArrays cells;
  cells.offsets = read_cell_array(layout, "offsets", count);
  cells.types = read_cell_array(layout, "types", count);
  const VtuArray& offsets = array_of(layout, "Cells", "offsets");
  for (std::size_t i = 0; i < count; ++i)
    if (cells.offsets[i] < (i == 0 ? 0 : cells.offsets[i - 1]))
      layout.fail(
          offsets.line,
          fmt::format("the offset of cell {} is smaller than the one before: the file is damaged; write it again", i));
  cells.connectivity =
      read_cell_array(layout, "connectivity", count == 0 ? 0 : static_cast<std::size_t>(cells.offsets.back()));
  cells.line = array_of(layout, "Cells", "connectivity").line;
  return cells;
}

Tetrahedron tetrahedron_at(const VtuLayout& layout, const CellArrays& cells, std::size_t cell, std::size_t points) {
  const std::int64_t begin = cell == 0 ? 0 : cells.offsets[cell - 1];
  if (cells.offsets[cell] - begin != 4)
    layout.fail(cells.line, fmt::format("cell {} is a tetrahedron with {} points: the file is damaged; write it again",
                                        cell, cells.offsets[cell] - begin));
  Tetrahedron t{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t point = cells.connectivity[static_cast<std::size_t>(begin) + i];
    if (point < 0 || static_cast<std::size_t>(point) >= points)
      layout.fail(cells.line,
                  fmt::format("cell {} has point {}, but there are only the points 0 to {}: write the grid again", cell,
                              point, static_cast<std::int64_t>(points) - 1));
    t[i] = static_cast<Index>(point);
  }
  return t;
}

[[noreturn]] void refuse_cell(const VtuLayout& layout, const CellArrays& cells, std::size_t cell) {
  layout.fail(cells.line,
              fmt::format("cell {} has VTK type {}, which cannot be used: write linear tetrahedra (type 10) only", cell,
                          cells.types[cell]));
}

}  // namespace

FileMesh read_vtu(const std::string& path, std::string_view bytes) {
  const VtuLayout layout = scan_vtu(path, bytes);
  FileMesh mesh;
  mesh.path = path;
  mesh.points = read_points(layout);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.point_numbers.push_back(static_cast<std::int64_t>(i));
  const CellArrays cells = read_cells(layout);
  for (std::size_t i = 0; i < cells.types.size(); ++i) {
    if (cells.types[i] >= 1 && cells.types[i] <= vtk_triangle) continue;
    if (cells.types[i] != vtk_tetrahedron) refuse_cell(layout, cells, i);
    mesh.tetrahedra.push_back({tetrahedron_at(layout, cells, i, mesh.points.size()), static_cast<std::int64_t>(i),
                               static_cast<std::int64_t>(cells.line)});
  }
  return mesh;
}

}  // namespace tessera
