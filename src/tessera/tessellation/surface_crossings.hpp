#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/geometry/surface_index.hpp"
#include "tessera/tessellation/surface_dual_cell.hpp"

namespace tessera {

/// An edge of a cell: runs counter-clockwise around face `left`, clockwise around face `right`, seen from outside.
struct CellEdge {
  Index from, to;
  Index left, right;
};

/// An edge of the surface; `low` < `high` number its ends among SurfaceCrossings::vertices.
struct SurfaceEdge {
  Index low, high;
};

/// An edge of a triangle: an edge of the surface, run through from its lower to its higher end (+1) or back (-1).
struct TriangleEdge {
  Index edge;
  int direction;
};

/// Where an edge of the cell goes through a triangle: +1 into the solid, -1 out of it.
struct EdgeCrossing {
  Index edge;
  Index triangle;  // among SurfaceCrossings::triangles
  int sign;
};

/// Where an edge of the surface goes through a face of the cell: +1 into the cell, -1 out of it, from low to high.
struct FaceCrossing {
  Index edge;
  Index face;
  std::array<Index, 3> corners;  // of the triangle of the face that it goes through
  int sign;
};

/// What a cell and a surface have in common, as a list of what goes through what. Every decision is exact and depends
/// only on what it is about, not on the cell it is made for: so cells agree, and all sums around closed lines vanish.
class SurfaceCrossings {
 public:
  /// Both must outlive this.
  SurfaceCrossings(Generators generators, const SurfaceIndex& index) : generators_(generators), index_(index) {}

  /// Finds everything for the cell of a particle that is in the solid.
  void find(const DualCell& cell);

  std::vector<Index> triangles;                       // that may meet the cell
  std::vector<std::array<TriangleEdge, 3>> boundary;  // of each of them, in their order
  std::vector<Index> vertices;                        // that they use, ascending
  std::vector<SurfaceEdge> surface_edges;
  std::vector<CellEdge> cell_edges;
  std::vector<EdgeCrossing> edge_crossings;
  std::vector<FaceCrossing> face_crossings;
  std::vector<int> corner_in;  // per corner of the cell: is it in the solid?
  std::vector<int> vertex_in;  // per vertex: is it in the cell?

 private:
  const Vec3& corner(Index c) const { return cell_->corner(c).X; }
  const Vec3& vertex(Index u) const { return index_.surface().vertex(vertices[static_cast<std::size_t>(u)]); }
  void list_cell_edges();
  void list_surface_edges();
  void cross_triangles();
  int pass(const Vec3& v0, const Vec3& v1, Index triangle) const;
  void follow_edges_from(Index start);
  void measure_heights();
  void cross_faces();
  int pass_face(const SurfaceEdge& edge, const std::array<Index, 3>& corners) const;
  int is_in_cell(Index u) const;
  double height(Index u, Index face) const {
    return heights_[static_cast<std::size_t>(u) * static_cast<std::size_t>(cell_->faces()) +
                    static_cast<std::size_t>(face)];
  }
  int place(Index u) const;

  Generators generators_;
  const SurfaceIndex& index_;
  const DualCell* cell_ = nullptr;
  Vec3 X_;
  Bounds box_;
  double margin_ = 0.0;  // heights larger than this have the right sign [m]
  std::vector<double> heights_;
  std::vector<Bounds> triangle_box_;
  std::vector<char> is_known_;
};

}  // namespace tessera
