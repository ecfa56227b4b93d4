#pragma once

#include "tessera/geometry/file_surface.hpp"

namespace tessera {

/// Small defects that were mended, each with how often.
struct SurfaceRepairs {
  double tolerance = 0.0;       // what was nearer than this was taken for one point [the file's unit]
  Index moved_vertices = 0;     // welded to another vertex that was near, but not in the same place
  Index flat_triangles = 0;     // dropped: without area, or thinner than the tolerance
  Index doubled_triangles = 0;  // dropped: there already
  Index back_to_back = 0;  // dropped: pairs of triangles on the same vertices that face each other, as touching walls
  Index split_triangles = 0;   // divided because a vertex of a neighbour lay on their edge
  Index turned_triangles = 0;  // turned round to agree with their neighbours

  bool any() const {
    return moved_vertices + flat_triangles + doubled_triangles + back_to_back + split_triangles + turned_triangles > 0;
  }
};

/// The distance below which two points of this surface are one: what single precision, in which most files are
/// written, leaves undecided at the largest coordinate.
double weld_tolerance(const TriangleSurface& surface);

/// Makes one vertex of those that are nearer to each other than repairs.tolerance and removes unused ones.
void weld_vertices(TriangleSurface& surface, SurfaceRepairs& repairs);

/// Drops triangles that are thinner than repairs.tolerance, doubled, or back to back with another. Of faces that have
/// triangles for both their sides one stays where it closes the surface.
void drop_needless_triangles(FileSurface& file, SurfaceRepairs& repairs);

/// Divides triangles at vertices of open edges that lie on their open edges, so that neighbours share whole edges.
///
///      a --- b --- c         the upper triangles end at b, the lower one does not know it:
///       \         /          it becomes two
///        \       /
///            d
void split_at_vertices_on_edges(FileSurface& file, SurfaceRepairs& repairs);

/// Turns the few triangles round that contradict their neighbours. Throws GeometryError when more than a quarter of
/// a connected patch does, or when it has one side only, as a Moebius strip.
void turn_contrary_triangles(FileSurface& file, SurfaceRepairs& repairs);

}  // namespace tessera
