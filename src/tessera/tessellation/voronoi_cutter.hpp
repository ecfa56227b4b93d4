#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/clip.hpp"
#include "tessera/tessellation/generators.hpp"
#include "tessera/tessellation/voronoi_nearest.hpp"
#include "tessera/tessellation/voronoi_simple_cell.hpp"

namespace tessera {

/// Makes one Voronoi or power cell after the other. Not thread-safe: one cutter belongs to one thread.
///
/// First every convex piece of the solid that the cell can reach is cut by the bisectors to ever farther particles,
/// until none can reach what is left. That is all for cells within one piece. Where a wall between two pieces goes
/// through a cell, the same bisectors then make the whole cell, and the pieces' walls cut that: so what the wall adds
/// to one part it takes from the other, digit by digit, even if the wall nearly coincides with a face of the cell.
///
/// Most cells lie within one piece and have no four planes that nearly meet in a point; those are made the quick way,
/// as a SimpleCell. As corners are placed by what meets there, the way does not show in the cell.
class VoronoiCutter {
 public:
  /// Face tags of the parts of a cell: the particle behind the face; a wall between two pieces of the solid, which
  /// is no face of the cell; or a side of the solid.
  static constexpr Index kInnerWall = -1;
  static constexpr Index tag_of_side(Index side) { return -2 - side; }
  static constexpr bool is_side(Index tag) { return tag <= -2; }
  static constexpr Index side_of(Index tag) { return -2 - tag; }

  /// All must outlive the cutter. The grid is that of grid_of(points, solid).
  VoronoiCutter(Generators points, const Solid& solid, const PointGrid& grid);
  static PointGrid grid_of(std::span<const Vec3> points, const Solid& solid);

  /// The parts of a cell, one for each piece of the solid that it meets; valid until the next call. Throws
  /// GeometryError when the particle is outside the solid or its own power cell, or coincides with another.
  std::span<const ConvexPolyhedron> cut(Index particle);

 private:
  using Polyhedra = std::vector<ConvexPolyhedron>;

  std::size_t piece_around(Index particle) const;
  bool cut_simply(Index particle);
  bool clip_by_walls(const ConvexPiece& piece, const Vec3& X);
  bool clip_by_neighbours(Index particle);
  bool write_simple_part(Index particle, std::size_t home);
  void find_parts(Index particle, double margin);
  void cut_by_neighbours(Index particle, std::size_t piece, double margin, ConvexPolyhedron& part);
  Plane bisector(Index particle, Index neighbour) const;
  bool can_reach(const ConvexPolyhedron& part, std::size_t from, std::size_t other) const;
  bool is_inner_wall(std::size_t piece, Index tag) const;
  bool has_inner_wall() const;
  void make_whole(Index particle);
  void cut_whole_by_pieces();
  void hand_faces_to_sides(std::size_t piece, ConvexPolyhedron& part) const;
  void finish_part(std::size_t piece, ConvexPolyhedron& part) const;
  void place_corners(Index particle, const ConvexPiece* piece, ConvexPolyhedron& part);

  struct Incidence {
    std::array<Index, 3> tags{};
    int count = 0;
  };

  Generators points_;
  const Solid& solid_;
  double tolerance_;
  Clipper clipper_;
  NearestPoints nearest_;
  double spacing_;  // mean, of the points [m]
  SimpleCell simple_;
  Polyhedra pieces_;                                 // of the solid, faces tagged by wall
  std::vector<std::vector<std::size_t>> cut_order_;  // of the walls of every piece

  Polyhedra parts_;                      // of the cell; the first `count_` are in use
  std::vector<std::size_t> part_piece_;  // the piece that each is in
  std::size_t count_ = 0;
  ConvexPolyhedron whole_;
  std::vector<Index> neighbours_;
  std::vector<Incidence> incidence_;
};

}  // namespace tessera
