#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/tessellation/surface_crossings.hpp"
#include "tessera/tessellation/surface_dual_cell.hpp"
#include "tessera/tessellation/surface_planes.hpp"

namespace tessera {

/// The lines that bound what a cell and a solid have in common: on every face of the cell those around its part in the
/// solid, on every triangle those around its part in the cell.
///
///     +------------+      Where edges of the cell go through triangles (o) and edges of triangles through faces of
///     |    ____x___o      the cell (x) are the ends of all lines. A line bounds two pieces, in opposite senses: so
///     |   /  in    |      the pieces close, whatever their outlines are.
///     +--o---------+
///
/// A point has the same bits in all cells. Not thread-safe.
class SurfaceLines {
 public:
  /// What kind of point it is, and the generators, vertices and triangle that meet there: the same in all cells.
  using Name = std::array<Index, 5>;

  struct Point {
    Vec3 X;  // relative to the particle [m]
    Name name;
  };
  /// Runs counter-clockwise around the piece on its carrier, seen from outside: a face of the cell, or, counted on
  /// from these, one of triangles().
  struct Line {
    Index carrier;
    Index from, to;  // points
  };

  /// All must outlive this.
  SurfaceLines(Generators generators, const SurfaceIndex& index, const SurfacePlanes& planes)
      : generators_(generators), index_(index), planes_(planes), crossings_(generators, index) {}

  /// Finds all lines for the cell of a particle in the solid. Throws GeometryError when the surface is not closed.
  void find(const DualCell& cell);

  const std::vector<Point>& points() const { return points_; }
  const std::vector<Line>& lines() const { return lines_; }
  const std::vector<Index>& triangles() const { return crossings_.triangles; }

 private:
  /// Where what is inside of a line begins or ends.
  struct End {
    double at;
    Index point;
  };
  /// An end of the line that a face of the cell and a triangle have in common.
  struct CutEnd {
    Index face, triangle, point;
    int sign;  // +1: the line around the face's piece begins here, -1: it ends
  };

  const Vec3& generator(Index g) const { return generators_[static_cast<std::size_t>(g)]; }
  Index neighbour(Index f) const { return cell_->neighbours[static_cast<std::size_t>(f)]; }
  const Vec3& surface_vertex(Index u) const;
  Index add_point(const Vec3& X, const Name& name);
  Vec3 place(const EdgeCrossing& crossing, const std::array<Index, 3>& generators) const;
  Vec3 place(const FaceCrossing& crossing) const;
  void add_corners();
  void trace_cell_edges();
  void trace_surface_edges();
  void trace_cuts();
  void add_end(int count, double at, Index point);
  template <class Emit>
  void join_ends(Emit&& emit);

  Generators generators_;
  const SurfaceIndex& index_;
  const SurfacePlanes& planes_;
  SurfaceCrossings crossings_;
  const DualCell* cell_ = nullptr;
  Vec3 X_;
  std::vector<Point> points_;
  std::vector<Line> lines_;
  std::vector<CutEnd> cut_ends_;
  std::vector<End> begins_, ends_;
  std::vector<Index> vertex_point_;
};

}  // namespace tessera
