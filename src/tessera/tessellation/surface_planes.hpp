#pragma once

#include <vector>

#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// The triangles of a surface put together to flat patches: neighbours on one side whose planes are the same to
/// round-off. Only these may be merged into one boundary face, for a pair of area vector and centroid keeps the first
/// moment of a flat face only.
struct SurfacePlanes {
  std::vector<Vec3> normal;   // per triangle: outward unit normal
  std::vector<Index> patch;   // per triangle
  std::vector<Index> side;    // per patch: index into TriangleSurface::side_names
  std::vector<Vec3> outward;  // per patch: unit normal of its first triangle
};

SurfacePlanes find_planes(const TriangleSurface& surface);

}  // namespace tessera
