#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/clip.hpp"
#include "tessera/tessellation/voronoi_convex.hpp"

namespace tessera {

/// Makes one Voronoi cell after the other and cuts it by the convex pieces of a solid. Not thread-safe: one cutter
/// belongs to one thread.
class VoronoiCutter {
 public:
  /// Face tags of the parts of a cell: the particle behind the face; a wall between two pieces of the solid, which
  /// is no face of the cell; or a side of the solid.
  static constexpr Index kInnerWall = -1;
  static constexpr Index tag_of_side(Index side) { return -2 - side; }
  static constexpr bool is_side(Index tag) { return tag <= -2; }
  static constexpr Index side_of(Index tag) { return -2 - tag; }

  /// Both must outlive the cutter. Errors as for ConvexVoronoi.
  VoronoiCutter(std::span<const Vec3> points, const Solid& solid);

  /// The parts of a cell, one for each piece of the solid that it meets; valid until the next call.
  std::span<const ConvexPolyhedron> cut(Index particle);

 private:
  bool is_within(const ConvexPiece& piece) const;
  void cut_by(const ConvexPiece& piece, ConvexPolyhedron& part);
  void place_corners(Index particle, const ConvexPiece* piece, ConvexPolyhedron& part);
  void place_on_walls(const ConvexPiece& piece, ConvexPolyhedron& part) const;

  struct Incidence {
    std::array<Index, 3> tags{};
    int count = 0;
  };

  std::span<const Vec3> points_;
  const Solid& solid_;
  double tolerance_;
  ConvexVoronoi convex_;
  Clipper clipper_;
  ConvexPolyhedron whole_;
  std::vector<ConvexPolyhedron> parts_;  // only the first of them are in use
  std::vector<Incidence> incidence_;
};

}  // namespace tessera
