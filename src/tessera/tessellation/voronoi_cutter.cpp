#include "tessera/tessellation/voronoi_cutter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/tessellation/voronoi_corner.hpp"

namespace tessera {
namespace {

/// Round-off of coordinates [m], with room for some arithmetic: what differs by less is the same.
double roundoff(const Solid& solid) {
  double largest = 0.0;
  for (int d = 0; d < 3; ++d)
    largest = std::max({largest, std::abs(solid.lower[d]), std::abs(solid.upper[d]), solid.upper[d] - solid.lower[d]});
  return 64.0 * std::numeric_limits<double>::epsilon() * largest;
}

/// While a cell is cut by a piece, the piece's walls are tagged by their number in it.
constexpr Index tag_of_wall(std::size_t wall) { return -2 - static_cast<Index>(wall); }
constexpr std::size_t wall_of(Index tag) { return static_cast<std::size_t>(-2 - tag); }

bool boxes_meet(const ConvexPolyhedron& polyhedron, const ConvexPiece& piece) {
  for (int d = 0; d < 3; ++d) {
    const auto below = [&](const Vec3& X) { return X[d] < piece.lower[d]; };
    const auto above = [&](const Vec3& X) { return X[d] > piece.upper[d]; };
    const auto& vertices = polyhedron.vertices;
    if (std::all_of(vertices.begin(), vertices.end(), below)) return false;
    if (std::all_of(vertices.begin(), vertices.end(), above)) return false;
  }
  return true;
}

}  // namespace

VoronoiCutter::VoronoiCutter(std::span<const Vec3> points, const Solid& solid)
    : points_(points),
      solid_(solid),
      tolerance_(roundoff(solid)),
      convex_(points, solid, tolerance_),
      clipper_(tolerance_) {}

std::span<const ConvexPolyhedron> VoronoiCutter::cut(Index particle) {
  convex_.compute(particle, whole_);
  std::size_t count = 0;
  for (const ConvexPiece& piece : solid_.pieces) {
    if (!boxes_meet(whole_, piece)) continue;
    if (count == parts_.size()) parts_.emplace_back();
    ConvexPolyhedron& part = parts_[count];
    part = whole_;
    if (is_within(piece)) {
      place_corners(particle, nullptr, part);
      return {parts_.data() + count, 1};
    }
    cut_by(piece, part);
    if (part.is_empty()) continue;
    place_corners(particle, &piece, part);
    ++count;
  }
  return {parts_.data(), count};
}

bool VoronoiCutter::is_within(const ConvexPiece& piece) const {
  return std::all_of(piece.walls.begin(), piece.walls.end(), [&](const ConvexPiece::Wall& wall) {
    return std::all_of(whole_.vertices.begin(), whole_.vertices.end(),
                       [&](const Vec3& X) { return wall.plane.height(X) < -tolerance_; });
  });
}

/// Where a face of the cell lies in a wall, the wall takes it if it bounds the solid; a wall between pieces leaves it
/// to the neighbour, whose cell sees it from the other side of the wall.
void VoronoiCutter::cut_by(const ConvexPiece& piece, ConvexPolyhedron& part) {
  for (std::size_t w = 0; w < piece.walls.size() && !part.is_empty(); ++w) {
    const ConvexPiece::Wall& wall = piece.walls[w];
    clipper_.clip(part, wall.plane, tag_of_wall(w),
                  wall.side >= 0 ? CoplanarFace::takes_the_cut : CoplanarFace::keeps_its_tag);
  }
}

/// Replaces the computed corners by those that every cell computes alike, and names the walls by the sides of the
/// solid. A corner of more than three faces is a coincidence of planes within round-off and stays as it is.
void VoronoiCutter::place_corners(Index particle, const ConvexPiece* piece, ConvexPolyhedron& part) {
  incidence_.assign(part.vertices.size(), {});
  for (Index f = 0; f < part.faces(); ++f)
    for (const Index v : part.face(f)) {
      Incidence& incidence = incidence_[static_cast<std::size_t>(v)];
      if (incidence.count < 3)
        incidence.tags[static_cast<std::size_t>(incidence.count)] = part.tags[static_cast<std::size_t>(f)];
      ++incidence.count;
    }
  for (std::size_t v = 0; v < part.vertices.size(); ++v) {
    if (incidence_[v].count != 3) continue;
    Corner corner;
    corner.add(particle);
    for (const Index tag : incidence_[v].tags)
      tag >= 0 ? corner.add(tag) : corner.add(piece->walls[wall_of(tag)].plane);
    part.vertices[v] = corner_position(points_, corner, part.vertices[v]);
  }
  if (piece) place_on_walls(*piece, part);
}

/// Makes the coordinate that a wall across an axis fixes exactly the wall's.
void VoronoiCutter::place_on_walls(const ConvexPiece& piece, ConvexPolyhedron& part) const {
  for (Index f = 0; f < part.faces(); ++f) {
    Index& tag = part.tags[static_cast<std::size_t>(f)];
    if (tag >= 0) continue;
    const ConvexPiece::Wall& wall = piece.walls[wall_of(tag)];
    for (int d = 0; d < 3; ++d)
      if (std::abs(wall.plane.normal[d]) == 1.0)
        for (const Index v : part.face(f))
          part.vertices[static_cast<std::size_t>(v)][d] = wall.plane.offset * wall.plane.normal[d];
    tag = wall.side >= 0 ? tag_of_side(wall.side) : kInnerWall;
  }
}

}  // namespace tessera
