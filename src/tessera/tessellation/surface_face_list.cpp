#include "tessera/tessellation/surface_face_list.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/tessellation/cell_closure.hpp"

namespace tessera {
namespace {

constexpr double kRoundoffFace = 1e-14;  // of V^(2/3): faces smaller than this are round-off

}  // namespace

double smallest_face(const Vec3& X, double V) {
  const double size = std::cbrt(V);
  return std::max(kRoundoffFace * size, round_off(X, V)) * size;
}

Symmetric3 moved(const Symmetric3& second, const Vec3& moment, double size, const Vec3& shift) {
  return second + symmetric_product(moment, shift) + size * square(shift);
}

void SurfaceFaceList::add(Index cell, const StoredFace& face, Index a, Index b, const std::vector<double>& volume) {
  if (a == b) return;
  const bool is_reversed = b >= 0 && a > b;
  if (is_reversed) std::swap(a, b);
  const auto i = static_cast<std::size_t>(a);
  if (std::abs(face.piece->size) < smallest_face(points_[i], volume[i])) return;
  const auto [low, high] =
      face.neighbour >= 0 ? std::minmax(cell, face.neighbour) : std::minmax(face.patch, face.patch);
  listed_.push_back({a, b, low, high, cell, is_reversed ? -1 : 1, face.piece, face.second});
}

std::tuple<Index, Index, Index, Index> SurfaceFaceList::key(const ListedFace& face) const {
  if (face.b < 0) return {face.a, side_of(face), face.low, 0};
  return {face.a, face.b, face.low, face.high};
}

/// Puts the pieces of one face together; positions are relative to the particle of its owner a.
FlatPiece SurfaceFaceList::together(std::span<const ListedFace> pieces) const {
  FlatPiece sum;
  for (const ListedFace& f : pieces) {
    const FlatArea& piece = *f.piece;
    const Vec3 shift = points_[static_cast<std::size_t>(f.cell)] - points_[static_cast<std::size_t>(f.a)];
    sum.area += static_cast<double>(f.sign) * piece.area;
    sum.moment += piece.moment + piece.size * shift;
    sum.size += piece.size;
    if (f.second != nullptr) sum.second += moved(*f.second, piece.moment, piece.size, shift);
  }
  return sum;
}

void SurfaceFaceList::move_to(Cells& cells) {
  std::stable_sort(listed_.begin(), listed_.end(), [this](const ListedFace& f, const ListedFace& g) {
    return (f.b < 0) != (g.b < 0) ? g.b < 0 : key(f) < key(g);
  });
  for (auto first = listed_.begin(); first != listed_.end();) {
    auto next = first + 1;
    while (next != listed_.end() && (next->b < 0) == (first->b < 0) && key(*next) == key(*first)) ++next;
    add_face(*first, together({first, next}), cells);
    first = next;
  }
  listed_ = {};
}

void SurfaceFaceList::add_face(const ListedFace& f, const FlatPiece& piece, Cells& cells) const {
  const Vec3 C = points_[static_cast<std::size_t>(f.a)] + piece.moment / piece.size;
  if (f.b < 0)
    cells.boundary.push_back({f.a, side_of(f), piece.area, C});
  else
    cells.interior.push_back(interior_face(f, piece.area, C));
  if (f.second != nullptr)
    (f.b < 0 ? cells.boundary_second_moment : cells.interior_second_moment)
        .push_back(piece.second - (1.0 / piece.size) * square(piece.moment));
}

InteriorFace SurfaceFaceList::interior_face(const ListedFace& f, const Vec3& area, const Vec3& centroid) const {
  const bool bisects = f.low == f.a && f.high == f.b;
  return {f.a, f.b, area, centroid, bisects, bisects ? cut_of(points_, f.a, f.b) : 0.5};
}

}  // namespace tessera
