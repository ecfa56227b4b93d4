#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/clip.hpp"
#include "tessera/tessellation/voronoi_nearest.hpp"

namespace tessera {

/// Makes one Voronoi cell after the other, in the convex pieces of a solid: a piece is cut by the bisectors to ever
/// farther particles, until none can reach what is left. Not thread-safe: one cutter belongs to one thread.
class VoronoiCutter {
 public:
  /// Face tags of the parts of a cell: the particle behind the face; a wall between two pieces of the solid, which
  /// is no face of the cell; or a side of the solid.
  static constexpr Index kInnerWall = -1;
  static constexpr Index tag_of_side(Index side) { return -2 - side; }
  static constexpr bool is_side(Index tag) { return tag <= -2; }
  static constexpr Index side_of(Index tag) { return -2 - tag; }

  /// Both must outlive the cutter.
  VoronoiCutter(std::span<const Vec3> points, const Solid& solid);

  /// The parts of a cell, one for each piece of the solid that it meets; valid until the next call. Throws
  /// GeometryError when the particle is outside the solid or coincides with another.
  std::span<const ConvexPolyhedron> cut(Index particle);

 private:
  std::size_t piece_around(Index particle) const;
  void cut_piece(Index particle, const ConvexPiece& piece, ConvexPolyhedron& part);
  bool can_reach(const ConvexPolyhedron& part, const ConvexPiece& from, const ConvexPolyhedron& other) const;
  void place_corners(Index particle, const ConvexPiece& piece, ConvexPolyhedron& part);
  static void place_on_walls(const ConvexPiece& piece, ConvexPolyhedron& part);
  static void tag_sides(const ConvexPiece& piece, ConvexPolyhedron& part);

  struct Incidence {
    std::array<Index, 3> tags{};
    int count = 0;
  };

  std::span<const Vec3> points_;
  const Solid& solid_;
  double tolerance_;
  Clipper clipper_;
  NearestPoints nearest_;
  std::vector<ConvexPolyhedron> pieces_;  // of the solid, faces tagged by wall
  std::vector<ConvexPolyhedron> parts_;   // only the first of them are in use
  std::vector<Incidence> incidence_;
};

}  // namespace tessera
