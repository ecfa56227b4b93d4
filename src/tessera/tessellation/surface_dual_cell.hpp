#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/tessellation/generators.hpp"
#include "tessera/tessellation/voronoi_nearest.hpp"

namespace tessera {

/// A Voronoi cell in general position: exactly three faces meet at every corner. Where more than four generators are
/// equally far from a point, ties are broken as if each generator had a tiny weight of its own, the same for all
/// cells. So cells that share a corner, an edge or a face agree on what meets there, and a corner has the same bits in
/// all of them. Coincidences show as edges and faces without extent.
struct DualCell {
  /// The generators that a corner is equally far from, ascending: its name in all cells.
  using Name = std::array<Index, 4>;

  struct Corner {
    std::array<Index, 3> faces{};  // counter-clockwise seen from outside
    Name name{};
    Vec3 X;  // [m]
  };

  Index particle = -1;
  std::vector<Index> neighbours;  // per face: the generator behind it
  std::vector<Corner> corners;
  std::vector<Index> begin;  // where each face's corners begin in `loops`, and the end
  std::vector<Index> loops;  // corners of all faces, counter-clockwise seen from outside, the lowest name first

  Index faces() const { return static_cast<Index>(neighbours.size()); }
  std::span<const Index> face(Index f) const {
    const auto i = static_cast<std::size_t>(f);
    return {loops.data() + begin[i], static_cast<std::size_t>(begin[i + 1] - begin[i])};
  }
  const Corner& corner(Index c) const { return corners[static_cast<std::size_t>(c)]; }
};

/// The grid in which neighbours are looked for: of all generators but the last four. `spacing` is that of the particles
/// [m].
PointGrid grid_of(std::span<const Vec3> generators, double spacing);

/// Makes one cell after the other. Not thread-safe: one cutter belongs to one thread.
class DualCellCutter {
 public:
  /// The last four generators must form a tetrahedron around all the others and be far from them. Generators and their
  /// grid must outlive the cutter.
  DualCellCutter(Generators generators, const PointGrid& grid);

  /// The cell of a generator; valid until the next call. Throws GeometryError when it coincides with another or lies
  /// outside its own power cell.
  const DualCell& cut(Index particle);

 private:
  /// The plane to a neighbour: normal . x = offset for x relative to the particle.
  struct Face {
    Index neighbour;
    Vec3 normal;
    double offset;
  };
  struct Vertex {
    std::array<Index, 3> faces;
    DualCell::Name name;
    Vec3 X;
    Vec3 x;           // relative to the particle
    double error;     // what the height of X above a bisector may be wrong by
    double distance;  // from the particle
  };
  struct Edge {
    Index from, to;
  };

  const Vec3& at(Index g) const { return generators_[static_cast<std::size_t>(g)]; }
  void start(Index particle);
  void add_face(Index neighbour);
  void add_vertex(Index i, Index j, Index k);
  bool is_cut_off(const Vertex& vertex, const Face& face) const;
  int side_of_sphere_through(const DualCell::Name& name, Index other) const;
  bool conflicts(const DualCell::Name& name, Index other) const;
  bool clip(Index neighbour);
  double farthest() const;
  void finish();

  Generators generators_;
  double magnitude_;  // of coordinates [m]
  NearestPoints nearest_;
  Index particle_ = -1;
  std::vector<Face> faces_;
  std::vector<Vertex> vertices_;
  std::vector<Vertex> removed_;
  std::vector<Edge> edges_;
  std::vector<Index> new_face_;
  std::vector<Index> next_;
  DualCell cell_;
};

}  // namespace tessera
