#include <cmath>

#include "tessera/tessellation/voronoi_corner.hpp"
#include "tessera/tessellation/voronoi_cutter.hpp"

namespace tessera {
namespace {

/// Half the width of the box that a simple cell starts from, in spacings: cells that are not smaller are not simple.
constexpr double kBoxWidth = 4.0;
/// A vertex this close to a plane, in distances of the particles or in tolerances, leaves doubt.
constexpr double kMargin = 1e-8;
constexpr double kMarginTolerances = 8.0;

constexpr std::size_t wall_of(Index tag) { return static_cast<std::size_t>(-2 - tag); }

}  // namespace

/// Makes the cell the quick way. False when it is not simple, or not certainly in one piece of the solid.
bool VoronoiCutter::cut_simply(Index particle) {
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  const std::size_t home = piece_around(particle);
  simple_.start(kBoxWidth * spacing_);
  nearest_.start(particle, X);
  if (!clip_by_walls(solid_.pieces[home], X) || !clip_by_neighbours(particle)) return false;
  return write_simple_part(particle, home);
}

bool VoronoiCutter::clip_by_walls(const ConvexPiece& piece, const Vec3& X) {
  const double margin = std::max(kMargin * spacing_, kMarginTolerances * tolerance_);
  for (std::size_t w = 0; w < piece.walls.size(); ++w) {
    const Plane& plane = piece.walls[w].plane;
    const double distance = -plane.height(X);
    if (distance * std::abs(distance) > simple_.radius2()) continue;
    const Index tag = -2 - static_cast<Index>(w);
    if (simple_.clip(plane.normal, distance, margin, tag) == SimpleCell::Outcome::in_doubt) return false;
  }
  return true;
}

bool VoronoiCutter::clip_by_neighbours(Index particle) {
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  const auto reach_of = [&] { return points_.reach(particle, std::sqrt(simple_.radius2()) + tolerance_); };
  double reach = reach_of();
  for (std::size_t rank = 0;; ++rank) {
    const Index neighbour = nearest_.neighbour(rank, reach);
    if (neighbour < 0) return true;
    const Vec3 branch = points_[static_cast<std::size_t>(neighbour)] - X;
    const double length2 = norm2(branch);
    if (length2 <= tolerance_ * tolerance_) return false;
    const double margin = std::max(kMargin * std::sqrt(length2), kMarginTolerances * tolerance_);
    const double offset = points_.offset(particle, neighbour, length2);
    if (offset < kLeastShare * length2) refuse_swallowed(points_, particle, neighbour);
    const SimpleCell::Outcome outcome = simple_.clip(branch, offset, margin, neighbour);
    if (outcome == SimpleCell::Outcome::in_doubt) return false;
    if (outcome == SimpleCell::Outcome::cut) reach = reach_of();
  }
}

/// Makes the simple cell the only part, its corners in their places. False if it has a face of the box or a wall
/// between pieces, or if the cell may have another part.
bool VoronoiCutter::write_simple_part(Index particle, std::size_t home) {
  const ConvexPiece& piece = solid_.pieces[home];
  const Vec3& X = points_[static_cast<std::size_t>(particle)];
  ConvexPolyhedron& part = parts_[0];
  part.clear();
  bool is_whole = true, has_wall = false;
  simple_.for_faces([&](Index tag, std::span<const Index> vertices) {
    is_whole = is_whole && tag != SimpleCell::kBox && !is_inner_wall(home, tag);
    has_wall = has_wall || tag < 0;
    part.corners.insert(part.corners.end(), vertices.begin(), vertices.end());
    part.close_face(tag);
  });
  if (!is_whole) return false;
  for (int v = 0; v < simple_.vertices(); ++v) {
    Corner corner;
    corner.add(particle);
    for (const Index tag : simple_.tags(v))
      if (tag >= 0)
        corner.add(tag);
      else
        corner.add(piece.walls[wall_of(tag)].plane);
    part.vertices.push_back(corner_position(points_, corner, X + simple_.position(v)));
  }
  count_ = 1;
  part_piece_[0] = home;
  if (!has_wall) return true;
  for (std::size_t other = 0; other < pieces_.size(); ++other)
    if (other != home && can_reach(part, home, other)) return false;
  finish_part(home, part);
  return true;
}

}  // namespace tessera
