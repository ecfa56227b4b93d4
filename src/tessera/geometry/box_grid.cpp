#include "tessera/geometry/box_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

constexpr double kCoincidence = 1e-12;  // of the size: coordinates closer than this are one plane

void check_box(const BoxShape& box, const Origin& origin) {
  for (int d = 0; d < 3; ++d) {
    if (std::isfinite(box.min[d]) && std::isfinite(box.max[d]) && box.min[d] < box.max[d]) continue;
    throw InputError(origin, fmt::format("the box is empty: min {0} = {1:g} m, max {0} = {2:g} m; min must be smaller "
                                         "than max in every direction",
                                         "xyz"[d], box.min[d], box.max[d]));
  }
}

void collect_boxes(const Shape& shape, std::vector<BoxShape>& boxes) {
  if (const auto* box = std::get_if<BoxShape>(&shape.kind)) {
    check_box(*box, shape.origin);
    boxes.push_back(*box);
    return;
  }
  const std::vector<Shape>& parts = *parts_of(shape);
  if (parts.empty()) throw InputError(shape.origin, "a union, difference or intersection needs at least one part");
  for (const Shape& part : parts) collect_boxes(part, boxes);
}

BoxGrid lay_grid(const std::vector<BoxShape>& boxes) {
  BoxGrid grid;
  for (int d = 0; d < 3; ++d) {
    std::vector<double> values;
    for (const BoxShape& box : boxes) values.insert(values.end(), {box.min[d], box.max[d]});
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double tolerance = kCoincidence * (*most - *least);
    grid.planes[static_cast<std::size_t>(d)] = merge_close(std::move(values), tolerance);
  }
  return grid;
}

std::vector<bool> cells_of_box(const BoxGrid& grid, const BoxShape& box) {
  std::array<int, 3> first{}, last{};
  for (std::size_t d = 0; d < 3; ++d) {
    first[d] = nearest_plane(grid.planes[d], box.min[static_cast<int>(d)]);
    last[d] = nearest_plane(grid.planes[d], box.max[static_cast<int>(d)]);
  }
  std::vector<bool> inside(grid.size(), false);
  for (int k = first[2]; k < last[2]; ++k)
    for (int j = first[1]; j < last[1]; ++j)
      for (int i = first[0]; i < last[0]; ++i) inside[grid.cell({i, j, k})] = true;
  return inside;
}

void find_bounds(const BoxGrid& grid, GridPart& part) {
  part.lower = {grid.cells(0), grid.cells(1), grid.cells(2)};
  part.upper = {0, 0, 0};
  for (int k = 0; k < grid.cells(2); ++k)
    for (int j = 0; j < grid.cells(1); ++j)
      for (int i = 0; i < grid.cells(0); ++i) {
        if (!part.inside[grid.cell({i, j, k})]) continue;
        const std::array<int, 3> c{i, j, k};
        for (std::size_t d = 0; d < 3; ++d) {
          part.lower[d] = std::min(part.lower[d], c[d]);
          part.upper[d] = std::max(part.upper[d], c[d] + 1);
        }
      }
}

/// Appends `shape` and, after it, its parts to `out`.
void add_part(const Shape& shape, const std::string& path, GriddedShape& out) {
  const std::size_t self = out.parts.size();
  out.parts.push_back({shape.name.empty() ? path : shape.name, !shape.name.empty(), {}, {}, {}});
  const std::string own_path = out.parts[self].path;
  std::vector<bool> inside;
  if (const auto* box = std::get_if<BoxShape>(&shape.kind)) {
    inside = cells_of_box(out.grid, *box);
  } else {
    const bool adds = std::holds_alternative<UnionShape>(shape.kind);
    const bool keeps_common = std::holds_alternative<IntersectionShape>(shape.kind);
    const std::vector<Shape>& parts = *parts_of(shape);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const std::size_t child = out.parts.size();
      add_part(parts[p], fmt::format("{}{}part{}", own_path, own_path.empty() ? "" : ".", p + 1), out);
      const std::vector<bool>& of_child = out.parts[child].inside;
      if (p == 0) inside = of_child;
      for (std::size_t c = 0; c < inside.size(); ++c)
        if (p > 0 && of_child[c] != keeps_common) inside[c] = adds;
    }
  }
  out.parts[self].inside = std::move(inside);
  find_bounds(out.grid, out.parts[self]);
}

}  // namespace

std::size_t BoxGrid::size() const { return static_cast<std::size_t>(cells(0)) * cells(1) * cells(2); }

std::size_t BoxGrid::cell(const std::array<int, 3>& c) const {
  return static_cast<std::size_t>(c[0]) +
         static_cast<std::size_t>(cells(0)) * (c[1] + static_cast<std::size_t>(cells(1)) * c[2]);
}

GriddedShape grid_shape(const Shape& shape) {
  std::vector<BoxShape> boxes;
  collect_boxes(shape, boxes);
  GriddedShape out;
  out.grid = lay_grid(boxes);
  for (const std::vector<double>& planes : out.grid.planes)
    if (planes.size() < 2) throw InputError(shape.origin, "every box of the shape is thinner than round-off");
  add_part(shape, "", out);
  const std::vector<bool>& inside = out.parts[0].inside;
  if (std::find(inside.begin(), inside.end(), true) == inside.end())
    throw InputError(shape.origin, "the shape is empty: its differences and intersections leave nothing");
  return out;
}

std::vector<double> merge_close(std::vector<double> values, double tolerance) {
  std::sort(values.begin(), values.end());
  std::vector<double> merged;
  for (const double v : values)
    if (merged.empty() || v - merged.back() > tolerance) merged.push_back(v);
  return merged;
}

int nearest_plane(const std::vector<double>& planes, double value) {
  const auto nearest = std::min_element(
      planes.begin(), planes.end(), [value](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
  return static_cast<int>(nearest - planes.begin());
}

}  // namespace tessera
