#include "tessera/tessellation/voronoi_cutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tessera/base/error.hpp"
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

/// While a piece is cut, its walls are tagged by their number in it.
constexpr Index tag_of_wall(std::size_t wall) { return -2 - static_cast<Index>(wall); }
constexpr std::size_t wall_of(Index tag) { return static_cast<std::size_t>(-2 - tag); }

double mean_spacing(std::span<const Vec3> points, const Solid& solid) {
  return std::cbrt(solid.volume / static_cast<double>(points.size()));
}

ConvexPolyhedron box(const Vec3& lower, const Vec3& upper, Index tag) {
  ConvexPolyhedron box;
  for (int v = 0; v < 8; ++v)
    box.vertices.push_back({v & 1 ? upper.x : lower.x, v & 2 ? upper.y : lower.y, v & 4 ? upper.z : lower.z});
  const std::array<std::array<Index, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& face : faces) {
    box.corners.insert(box.corners.end(), face.begin(), face.end());
    box.close_face(tag);
  }
  return box;
}

ConvexPolyhedron polyhedron_of(const ConvexPiece& piece, Clipper& clipper) {
  const Vec3 margin = piece.upper - piece.lower;
  ConvexPolyhedron polyhedron = box(piece.lower - margin, piece.upper + margin, VoronoiCutter::kInnerWall);
  for (std::size_t w = 0; w < piece.walls.size(); ++w) clipper.clip(polyhedron, piece.walls[w].plane, tag_of_wall(w));
  return polyhedron;
}

double farthest_vertex(const ConvexPolyhedron& part, const Vec3& X) {
  double largest = 0.0;
  for (const Vec3& vertex : part.vertices) largest = std::max(largest, norm2(vertex - X));
  return std::sqrt(largest);
}

std::string named(std::span<const Vec3> points, Index a) {
  const Vec3& X = points[static_cast<std::size_t>(a)];
  return fmt::format("{} at ({:g}, {:g}, {:g}) m", a, X.x, X.y, X.z);
}

}  // namespace

VoronoiCutter::VoronoiCutter(std::span<const Vec3> points, const Solid& solid)
    : points_(points),
      solid_(solid),
      tolerance_(roundoff(solid)),
      clipper_(tolerance_),
      nearest_(points, solid.lower, solid.upper, mean_spacing(points, solid)) {
  for (const ConvexPiece& piece : solid.pieces) {
    pieces_.push_back(polyhedron_of(piece, clipper_));
    place_on_walls(piece, pieces_.back());
  }
}

/// The cell is convex, so the line from the particle to any other part of it leaves the part around the particle
/// through one of that part's walls. Most cells have none.
std::span<const ConvexPolyhedron> VoronoiCutter::cut(Index particle) {
  nearest_.start(particle);
  if (parts_.size() < pieces_.size()) parts_.resize(pieces_.size());
  const std::size_t home = piece_around(particle);
  parts_[0] = pieces_[home];
  cut_piece(particle, solid_.pieces[home], parts_[0]);
  std::size_t count = 1;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    if (p == home || !can_reach(parts_[0], solid_.pieces[home], pieces_[p])) continue;
    ConvexPolyhedron& part = parts_[count];
    part = pieces_[p];
    cut_piece(particle, solid_.pieces[p], part);
    if (part.is_empty()) continue;
    place_corners(particle, solid_.pieces[p], part);
    ++count;
  }
  if (!parts_[0].is_empty()) place_corners(particle, solid_.pieces[home], parts_[0]);
  return {parts_.data(), count};
}

std::size_t VoronoiCutter::piece_around(Index particle) const {
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  for (std::size_t p = 0; p < solid_.pieces.size(); ++p) {
    const auto& walls = solid_.pieces[p].walls;
    if (std::all_of(walls.begin(), walls.end(), [&](const auto& wall) { return wall.plane.height(X) <= tolerance_; }))
      return p;
  }
  throw GeometryError("particle " + named(points_, particle) + " lies outside the solid");
}

/// Where a bisector lies on a face of the piece, the face goes to the neighbour if it is a wall between pieces, for
/// the neighbour's cell has that face too, from the other side. A face that bounds the solid stays as it is.
void VoronoiCutter::cut_piece(Index particle, const ConvexPiece& piece, ConvexPolyhedron& part) {
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  double reach = 2.0 * farthest_vertex(part, X) + tolerance_;
  for (std::size_t rank = 0;; ++rank) {
    const Index neighbour = nearest_.neighbour(rank, reach);
    if (neighbour < 0) return;
    const Vec3 branch = points_[static_cast<std::size_t>(neighbour)] - X;
    const double length = norm(branch);
    if (length <= tolerance_)
      throw GeometryError("particles " + named(points_, particle) + " and " + named(points_, neighbour) + " coincide");
    const Vec3 normal = branch / length;
    switch (clipper_.clip(part, {normal, dot(normal, X) + 0.5 * length}, neighbour)) {
      case Clipper::Outcome::emptied:
        return;
      case Clipper::Outcome::cut:
        reach = 2.0 * farthest_vertex(part, X) + tolerance_;
        break;
      case Clipper::Outcome::untouched:
        const Index face = clipper_.touched_face(part);
        if (face < 0) break;
        Index& tag = part.tags[static_cast<std::size_t>(face)];
        if (tag < 0 && piece.walls[wall_of(tag)].side < 0) tag = neighbour;
    }
  }
}

/// Has `other` points behind one of the walls that bound `part`?
bool VoronoiCutter::can_reach(const ConvexPolyhedron& part, const ConvexPiece& from,
                              const ConvexPolyhedron& other) const {
  return std::any_of(part.tags.begin(), part.tags.end(), [&](Index tag) {
    if (tag >= 0) return false;
    const Plane& plane = from.walls[wall_of(tag)].plane;
    return std::any_of(other.vertices.begin(), other.vertices.end(),
                       [&](const Vec3& X) { return plane.height(X) > tolerance_; });
  });
}

/// Replaces the computed corners by those that every cell computes alike, and names the walls by the sides of the
/// solid. A corner of more than three faces is a coincidence of planes within round-off and stays as it is.
void VoronoiCutter::place_corners(Index particle, const ConvexPiece& piece, ConvexPolyhedron& part) {
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
    for (const Index tag : incidence_[v].tags) {
      if (tag >= 0)
        corner.add(tag);
      else
        corner.add(piece.walls[wall_of(tag)].plane);
    }
    part.vertices[v] = corner_position(points_, corner, part.vertices[v]);
  }
  place_on_walls(piece, part);
  tag_sides(piece, part);
}

/// Makes the coordinate that a wall across an axis fixes exactly the wall's.
void VoronoiCutter::place_on_walls(const ConvexPiece& piece, ConvexPolyhedron& part) {
  for (Index f = 0; f < part.faces(); ++f) {
    const Index tag = part.tags[static_cast<std::size_t>(f)];
    if (tag >= 0) continue;
    const Plane& plane = piece.walls[wall_of(tag)].plane;
    for (int d = 0; d < 3; ++d)
      if (std::abs(plane.normal[d]) == 1.0)
        for (const Index v : part.face(f))
          part.vertices[static_cast<std::size_t>(v)][d] = plane.offset * plane.normal[d];
  }
}

void VoronoiCutter::tag_sides(const ConvexPiece& piece, ConvexPolyhedron& part) {
  for (Index& tag : part.tags) {
    if (tag >= 0) continue;
    const Index side = piece.walls[wall_of(tag)].side;
    tag = side >= 0 ? tag_of_side(side) : kInnerWall;
  }
}

}  // namespace tessera
