#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tessera/geometry/surface_index.hpp"
#include "tessera/tessellation/surface_planes.hpp"
#include "tessera/tessellation/voronoi_cutter.hpp"

namespace tessera {

/// What relaxation needs to know of a cell.
struct CellCentroid {
  double volume = 0.0;  // [m3]
  Vec3 X;               // [m]
};

/// Volume and centroid of convex parts, by tetrahedra from `base` to their faces.
CellCentroid centroid_of(std::span<const ConvexPolyhedron> parts, const Vec3& base);

/// Centroids of the Voronoi cells of points in a solid of convex pieces.
class CentroidsInSolid {
 public:
  explicit CentroidsInSolid(const Solid& solid);

  void find(std::span<const Vec3> points, std::vector<CellCentroid>& centroids) const;
  /// Is X inside, not on the boundary?
  bool contains(const Vec3& X) const;

 private:
  const Solid& solid_;
  double tolerance_;  // [m]
};

/// The same for the solid that a surface encloses. Of a cell that the surface cuts into parts it is the part around the
/// particle.
class CentroidsInSurface {
 public:
  /// `points` of them will fill the solid.
  CentroidsInSurface(const SurfaceIndex& index, std::size_t points);

  void find(std::span<const Vec3> points, std::vector<CellCentroid>& centroids) const;
  bool contains(const Vec3& X) const { return index_.location(X) == Location::inside; }

 private:
  const SurfaceIndex& index_;
  SurfacePlanes planes_;
  double spacing_;           // mean [m]
  std::vector<Vec3> fence_;  // around the surface
  Solid around_;             // the box that it fills
};

}  // namespace tessera
