#pragma once

#include <span>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/symmetric.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/generators.hpp"

namespace tessera {

/// The face between the cells of particles a < b. `area` points from a to b [m2].
struct InteriorFace {
  Index a = 0;
  Index b = 0;
  Vec3 area;
  Vec3 centroid;
  bool bisects = true;  // false: of a part that one of the cells took over from another, so in another plane
  double cut = 0.5;     // where the face's plane cuts the branch, as a fraction of the way from a to b; not half: power
};

/// The part of a cell's surface that lies on one side of the solid. `area` points out of the solid [m2].
struct BoundaryFace {
  Index owner = 0;
  Index side = 0;  // index into Solid::sides or TriangleSurface::side_names
  Vec3 area;
  Vec3 centroid;
};

/// How far moments of cells and faces are computed: volumes, areas and centroids only; the second moments of cells too;
/// or those of faces as well.
enum class Moments { first, second_of_cells, second_of_faces };

/// Voronoi cells cut by a solid. Each face is computed once, so both cells see the same numbers. Faces between one pair
/// or of one owner and side are merged where they are in one plane.
struct Cells {
  std::vector<double> volume;          // [m3]
  std::vector<Vec3> centroid;          // [m]
  std::vector<InteriorFace> interior;  // sorted by (a, b)
  std::vector<BoundaryFace> boundary;  // sorted by (owner, side)

  // Second moments about the centroid, empty where they were not asked for: the integrals of (Y - C) (x) (Y - C) over
  // each cell [m5] and over each face [m4], the latter in the order of the faces.
  std::vector<Symmetric3> second_moment;
  std::vector<Symmetric3> interior_second_moment, boundary_second_moment;
};

/// The Voronoi cells of `points` in `solid`, or their power cells if they have weights; a cell has the index of its
/// point. Throws GeometryError that names the particle when one is outside the solid or its own power cell, two
/// coincide, or a cell is empty or does not close.
Cells voronoi_cells(const Generators& points, const Solid& solid, Moments moments = Moments::first);

/// One convex part of a cell, for pictures. Faces list vertices counter-clockwise seen from outside.
struct Polyhedron {
  Index particle = 0;
  std::vector<Vec3> vertices;
  std::vector<std::vector<Index>> faces;
};

/// The cells as polyhedra, ordered by particle; a cell that the solid cuts into several pieces gives several.
std::vector<Polyhedron> voronoi_polyhedra(const Generators& points, const Solid& solid);

}  // namespace tessera
