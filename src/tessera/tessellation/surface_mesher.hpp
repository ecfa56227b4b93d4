#pragma once

#include <vector>

#include "tessera/geometry/mesh_file.hpp"
#include "tessera/tessellation/surface_features.hpp"
#include "tessera/tessellation/surface_mesh.hpp"

namespace tessera {

/// Points and tetrahedra of Mesh_3, with the lines kept; without sides, in no particular order. Throws GeometryError
/// when this build has no CGAL.
struct RawMesh {
  std::vector<Vec3> points;
  std::vector<Tetrahedron> tetrahedra;
};
RawMesh mesh_with_cgal(const TriangleSurface& surface, const SurfaceFeatures& features, double spacing);

}  // namespace tessera
