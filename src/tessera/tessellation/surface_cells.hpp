#pragma once

#include <span>

#include "tessera/geometry/surface_index.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// Voronoi cells in a solid that a surface bounds, and what was done to make them.
struct SurfaceCells {
  Cells cells;
  Index adopted = 0;            // parts that the surface cuts off from their particle; a neighbour's cell has them now
  double adopted_volume = 0.0;  // [m3]
  std::vector<Polyhedron> polyhedra;  // for pictures, if wanted: the parts that a particle's cell is made of
};

/// Are the outlines of cells kept for pictures? They need not be convex, and may be hollow.
enum class Pictures { omitted, wanted };

/// The Voronoi cells of `points` in the solid that a closed surface bounds, cut exactly, whatever its shape; a cell has
/// the index of its point. Power cells if the points have weights. A boundary face is flat: cells have one for every
/// plane of a side that they reach.
///
/// A cell that the surface cuts into several parts keeps the one around its particle. The others go to the cells
/// behind their largest faces, whose interior faces then need not bisect anything.
///
/// Throws GeometryError that names the particle when one is not inside, two coincide, or a part of more than half its
/// cell is cut off; and when a part of the solid holds no particle at all.
SurfaceCells surface_cells(const Generators& points, const SurfaceIndex& index, Moments moments = Moments::first,
                           Pictures pictures = Pictures::omitted);

}  // namespace tessera
