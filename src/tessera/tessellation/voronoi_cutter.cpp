#include "tessera/tessellation/voronoi_cutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tessera/base/error.hpp"
#include "tessera/tessellation/plane_order.hpp"
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

/// Pieces that a cell is this near to, in tolerances, get their chance to have a sliver of it.
constexpr double kTouch = 4.0;

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

/// An order of the walls that pieces with common walls agree on: then both cut the same edges at the same points.
std::vector<std::size_t> cut_order(const ConvexPiece& piece) {
  std::vector<std::size_t> order(piece.walls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t v, std::size_t w) { return comes_before(piece.walls[v].plane, piece.walls[w].plane); });
  return order;
}

/// Makes the coordinate that a wall across an axis fixes exactly the wall's.
void place_on_walls(const ConvexPiece& piece, ConvexPolyhedron& part) {
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

void tag_sides(const ConvexPiece& piece, ConvexPolyhedron& part) {
  for (Index& tag : part.tags) {
    if (tag >= 0) continue;
    const Index side = piece.walls[wall_of(tag)].side;
    tag = side >= 0 ? VoronoiCutter::tag_of_side(side) : VoronoiCutter::kInnerWall;
  }
}

double farthest_vertex(const ConvexPolyhedron& part, const Vec3& X) {
  double largest = 0.0;
  for (const Vec3& vertex : part.vertices) largest = std::max(largest, norm2(vertex - X));
  return std::sqrt(largest);
}

}  // namespace

VoronoiCutter::VoronoiCutter(Generators points, const Solid& solid, const PointGrid& grid)
    : points_(points),
      solid_(solid),
      tolerance_(roundoff(solid)),
      clipper_(tolerance_),
      nearest_(grid),
      spacing_(mean_spacing(points.points(), solid)) {
  for (const ConvexPiece& piece : solid.pieces) {
    pieces_.push_back(polyhedron_of(piece, clipper_));
    place_on_walls(piece, pieces_.back());
    cut_order_.push_back(cut_order(piece));
  }
  parts_.resize(pieces_.size());
  part_piece_.resize(pieces_.size());
}

PointGrid VoronoiCutter::grid_of(std::span<const Vec3> points, const Solid& solid) {
  return {points, solid.lower, solid.upper, mean_spacing(points, solid)};
}

std::span<const ConvexPolyhedron> VoronoiCutter::cut(Index particle) {
  if (cut_simply(particle)) return {parts_.data(), count_};
  find_parts(particle, 0.0);
  if (has_inner_wall()) {
    find_parts(particle, kTouch * tolerance_);
    make_whole(particle);
    cut_whole_by_pieces();
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const ConvexPiece& piece = solid_.pieces[part_piece_[i]];
    place_corners(particle, &piece, parts_[i]);
    finish_part(part_piece_[i], parts_[i]);
  }
  return {parts_.data(), count_};
}

void VoronoiCutter::finish_part(std::size_t piece, ConvexPolyhedron& part) const {
  place_on_walls(solid_.pieces[piece], part);
  tag_sides(solid_.pieces[piece], part);
}

/// The cell is convex, so the line from the particle to any other part of it leaves the part around the particle
/// through one of that part's walls. Most cells have none. With a margin [m] the cell is that much larger on all sides.
void VoronoiCutter::find_parts(Index particle, double margin) {
  nearest_.start(particle, points_[static_cast<std::size_t>(particle)]);
  const std::size_t home = piece_around(particle);
  count_ = 0;
  const auto add_part = [&](std::size_t piece) {
    parts_[count_] = pieces_[piece];
    cut_by_neighbours(particle, piece, margin, parts_[count_]);
    if (!parts_[count_].is_empty()) part_piece_[count_++] = piece;
  };
  add_part(home);
  if (count_ == 0) return;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece)
    if (piece != home && can_reach(parts_[0], home, piece)) add_part(piece);
}

std::size_t VoronoiCutter::piece_around(Index particle) const {
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  for (std::size_t p = 0; p < solid_.pieces.size(); ++p) {
    const auto& walls = solid_.pieces[p].walls;
    if (std::all_of(walls.begin(), walls.end(), [&](const auto& wall) { return wall.plane.height(X) <= tolerance_; }))
      return p;
  }
  throw GeometryError("particle " + points_.named(particle) + " lies outside the solid");
}

Plane VoronoiCutter::bisector(Index particle, Index neighbour) const {
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  const Vec3 branch = points_[static_cast<std::size_t>(neighbour)] - X;
  const double length = norm(branch);
  if (length <= tolerance_)
    throw GeometryError("particles " + points_.named(particle) + " and " + points_.named(neighbour) + " coincide");
  const double distance = points_.distance(particle, neighbour, length);
  if (distance < kLeastShare * length) refuse_swallowed(points_, particle, neighbour);
  const Vec3 normal = branch / length;
  return {normal, dot(normal, X) + distance};
}

/// Where a bisector lies on a face of the piece, the face goes to the neighbour if it is a wall between pieces, for
/// the neighbour's cell has that face too, from the other side. A face that bounds the solid stays as it is.
void VoronoiCutter::cut_by_neighbours(Index particle, std::size_t piece, double margin, ConvexPolyhedron& part) {
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  const auto reach_of = [&] { return points_.reach(particle, farthest_vertex(part, X) + margin + tolerance_); };
  double reach = reach_of();
  for (std::size_t rank = 0;; ++rank) {
    const Index neighbour = nearest_.neighbour(rank, reach);
    if (neighbour < 0) return;
    Plane plane = bisector(particle, neighbour);
    plane.offset += margin;
    const Clipper::Outcome outcome = clipper_.clip(part, plane, neighbour);
    if (outcome == Clipper::Outcome::emptied) return;
    if (outcome == Clipper::Outcome::cut) {
      reach = reach_of();
      continue;
    }
    for (Index f = 0; f < part.faces(); ++f) {
      Index& tag = part.tags[static_cast<std::size_t>(f)];
      if (is_inner_wall(piece, tag) && clipper_.lies_in(part, f, plane)) tag = neighbour;
    }
  }
}

/// Has piece `other` points behind one of the walls, of piece `from`, that bound `part`?
bool VoronoiCutter::can_reach(const ConvexPolyhedron& part, std::size_t from, std::size_t other) const {
  const std::vector<Vec3>& points = pieces_[other].vertices;
  return std::any_of(part.tags.begin(), part.tags.end(), [&](Index tag) {
    if (tag >= 0) return false;
    const Plane& plane = solid_.pieces[from].walls[wall_of(tag)].plane;
    return std::any_of(points.begin(), points.end(), [&](const Vec3& X) { return plane.height(X) > tolerance_; });
  });
}

bool VoronoiCutter::is_inner_wall(std::size_t piece, Index tag) const {
  return tag < 0 && solid_.pieces[piece].walls[wall_of(tag)].side < 0;
}

bool VoronoiCutter::has_inner_wall() const {
  for (std::size_t i = 0; i < count_; ++i)
    for (const Index tag : parts_[i].tags)
      if (is_inner_wall(part_piece_[i], tag)) return true;
  return false;
}

/// The cell in a box around the solid, from the neighbours that its parts have.
void VoronoiCutter::make_whole(Index particle) {
  neighbours_.clear();
  for (std::size_t i = 0; i < count_; ++i)
    for (const Index tag : parts_[i].tags)
      if (tag >= 0) neighbours_.push_back(tag);
  std::sort(neighbours_.begin(), neighbours_.end());
  neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
  const Vec3 margin = solid_.upper - solid_.lower;
  whole_ = box(solid_.lower - margin, solid_.upper + margin, kInnerWall);
  for (const Index neighbour : neighbours_) clipper_.clip(whole_, bisector(particle, neighbour), neighbour);
  place_corners(particle, nullptr, whole_);
}

void VoronoiCutter::cut_whole_by_pieces() {
  const std::size_t candidates = count_;
  count_ = 0;
  for (std::size_t i = 0; i < candidates; ++i) {
    const std::size_t piece = part_piece_[i];
    ConvexPolyhedron& part = parts_[count_];
    part = whole_;
    for (const std::size_t w : cut_order_[piece])
      if (!part.is_empty()) clipper_.split(part, solid_.pieces[piece].walls[w].plane, tag_of_wall(w));
    if (part.is_empty()) continue;
    part_piece_[count_++] = piece;
    hand_faces_to_sides(piece, part);
  }
}

/// A face of the cell that lies in a wall that bounds the solid belongs to the wall: there is no neighbour behind it.
void VoronoiCutter::hand_faces_to_sides(std::size_t piece, ConvexPolyhedron& part) const {
  const auto& walls = solid_.pieces[piece].walls;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (walls[w].side < 0) continue;
    for (Index f = 0; f < part.faces(); ++f)
      if (clipper_.lies_in(part, f, walls[w].plane)) part.tags[static_cast<std::size_t>(f)] = tag_of_wall(w);
  }
}

/// Replaces the computed corners by those that every cell computes alike. A corner of more than three faces is a
/// coincidence of planes within round-off and stays as it is.
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
    const auto& [tags, count] = incidence_[v];
    const bool is_beyond = !piece && *std::min_element(tags.begin(), tags.end()) < 0;
    if (count != 3 || is_beyond) continue;
    Corner corner;
    corner.add(particle);
    for (const Index tag : tags) {
      if (tag >= 0)
        corner.add(tag);
      else
        corner.add(piece->walls[wall_of(tag)].plane);
    }
    part.vertices[v] = corner_position(points_, corner, part.vertices[v]);
  }
}

}  // namespace tessera
