#include "tessera/simulation/side_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// A point; coordinates that are round-off of the body's are zero.
std::string point_text(const Vec3& X, double size) {
  const auto clean = [&](double x) { return std::abs(x) < 1e-12 * size ? 0.0 : x; };
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", clean(X.x), clean(X.y), clean(X.z));
}

std::string other_names(const SideRow& row) {
  if (row.names.size() < 2) return {};
  return fmt::format("  also {}", fmt::join(row.names.begin() + 1, row.names.end(), ", "));
}

}  // namespace

std::vector<SideRow> side_rows(const Surface& surface, const std::vector<SideSummary>& sides) {
  std::vector<SideRow> rows;
  for (std::size_t s = 0; s < sides.size(); ++s) rows.push_back({surface.body, surface.side_names[s], sides[s], 0});
  for (const SurfacePiece& piece : surface.pieces) ++rows[static_cast<std::size_t>(piece.side)].faces;
  return rows;
}

std::string to_text(const std::vector<SideRow>& rows) {
  std::size_t width = 4;
  double size = 0.0;
  for (const SideRow& row : rows) {
    width = std::max(width, row.body.size() + row.names[0].size() + 2);
    size = std::max({size, norm(row.side.box.lower), norm(row.side.box.upper)});
  }
  std::string text = fmt::format("{:<{}} {:>12} {:>9} {:>9}  from, to [m]\n", "body: side", width + 1, "area [m2]",
                                 "faces", "triangles");
  for (const SideRow& row : rows)
    text += fmt::format("{:<{}} {:>12.6g} {:>9} {:>9}  {}, {}{}\n", row.body + ": " + row.names[0], width + 1,
                        row.side.area, row.faces, row.side.triangles, point_text(row.side.box.lower, size),
                        point_text(row.side.box.upper, size), other_names(row));
  return text;
}

}  // namespace tessera
