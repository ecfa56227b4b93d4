#pragma once

#include <memory>
#include <span>

#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/clip.hpp"

namespace tessera {

/// The convex Voronoi cells of points, before a solid cuts them, made by voro++ (Rycroft, Chaos 19 (2009) 041111) in
/// a box somewhat larger than the solid's.
class ConvexVoronoi {
 public:
  /// Face tag where a cell ends at the box; the solid cuts all such faces off.
  static constexpr Index kBoxTag = -1;

  /// Vertices that are closer to a bisecting plane than `tolerance` [m] count as lying on it. Throws GeometryError for
  /// points outside the solid's bounding box.
  ConvexVoronoi(std::span<const Vec3> points, const Solid& solid, double tolerance);
  ConvexVoronoi(const ConvexVoronoi&) = delete;
  ~ConvexVoronoi();

  /// Computes the cell of `particle`; faces are tagged by the particle behind them. Empty when there is no cell.
  void compute(Index particle, ConvexPolyhedron& cell);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tessera
