#include "tessera/tessellation/surface_parts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

constexpr double kNoVolume = 1e-12;   // of the cell: what is smaller is round-off where faces lie on the surface
constexpr double kLargestPart = 0.5;  // of the cell: what is cut off from the particle may not be larger

}  // namespace

SplitCells::SplitCells(Generators points, std::span<const std::unique_ptr<CutCell>> cells)
    : points_(points), cells_(cells), owner_(cells.size()) {
  for (std::size_t a = 0; a < cells.size(); ++a) {
    if (!cells[a]) continue;
    owner_[a].assign(cells[a]->parts.size(), -1);
    owner_[a][static_cast<std::size_t>(cells[a]->home)] = static_cast<Index>(a);
  }
  check_sizes();
  while (adopt()) {
  }
  keep_flat_parts();
  check_adopted();
}

Index SplitCells::owner(Index cell, Index part) const {
  return owner_[static_cast<std::size_t>(cell)][static_cast<std::size_t>(part)];
}

/// Both cells know the same closed lines around their common face.
Index SplitCells::part_behind(Index cell, const CutFace& face) const {
  const CutCell& other = *cells_[static_cast<std::size_t>(face.neighbour)];
  for (const CutFace& back : other.faces)
    if (back.neighbour == cell && back.name == face.name) return back.part;
  return other.home;
}

Index SplitCells::owner_behind(Index cell, const CutFace& face) const {
  if (!cells_[static_cast<std::size_t>(face.neighbour)]) return face.neighbour;
  return owner(face.neighbour, part_behind(cell, face));
}

/// One round: every part without an owner gets that behind its largest face that has one. Did any?
bool SplitCells::adopt() {
  std::vector<std::vector<Index>> next = owner_;
  bool is_new = false;
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    if (!cells_[a]) continue;
    std::vector<double> largest(owner_[a].size(), 0.0);
    for (const CutFace& face : cells_[a]->faces) {
      const auto part = static_cast<std::size_t>(face.part);
      if (owner_[a][part] >= 0 || face.neighbour < 0 || face.piece.size <= largest[part]) continue;
      const Index owner = owner_behind(static_cast<Index>(a), face);
      if (owner < 0) continue;
      next[a][part] = owner;
      largest[part] = face.piece.size;
      is_new = true;
    }
  }
  owner_ = std::move(next);
  return is_new;
}

void SplitCells::report(Index cell, Index part, const char* text) const {
  const Vec3& X = points_[static_cast<std::size_t>(cell)];
  const CutCell::Part& p = cells_[static_cast<std::size_t>(cell)]->parts[static_cast<std::size_t>(part)];
  const Vec3 center = X + p.moment / p.volume;
  throw GeometryError(
      fmt::format("the surface cuts {:.3g} m3 around ({:g}, {:g}, {:g}) m off from particle {}, to whose "
                  "Voronoi cell it belongs, {}; use a finer spacing or put particles there",
                  p.volume, center.x, center.y, center.z, points_.named(cell), text));
}

void SplitCells::check_sizes() const {
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    if (!cells_[a]) continue;
    double total = 0.0;
    for (const CutCell::Part& part : cells_[a]->parts) total += part.volume;
    for (std::size_t p = 0; p < cells_[a]->parts.size(); ++p)
      if (static_cast<Index>(p) != cells_[a]->home && cells_[a]->parts[p].volume > kLargestPart * total)
        report(static_cast<Index>(a), static_cast<Index>(p), "and that is more than half of the cell");
  }
}

/// Flat parts between flat parts of other cells hold nothing that could be lost.
void SplitCells::keep_flat_parts() {
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    if (!cells_[a]) continue;
    double total = 0.0;
    for (const CutCell::Part& part : cells_[a]->parts) total += part.volume;
    for (std::size_t p = 0; p < owner_[a].size(); ++p)
      if (owner_[a][p] < 0 && std::abs(cells_[a]->parts[p].volume) <= kNoVolume * total)
        owner_[a][p] = static_cast<Index>(a);
  }
}

void SplitCells::check_adopted() const {
  for (std::size_t a = 0; a < cells_.size(); ++a)
    for (std::size_t p = 0; p < owner_[a].size(); ++p)
      if (owner_[a][p] < 0) report(static_cast<Index>(a), static_cast<Index>(p), "and from all others");
}

}  // namespace tessera
