#pragma once

#include <vector>

#include "tessera/geometry/mesh_file.hpp"
#include "tessera/tessellation/surface_features.hpp"
#include "tessera/tessellation/surface_mesh.hpp"

namespace tessera {

/// Points and tetrahedra of a mesher, with the lines kept; without sides, in no particular order.
struct RawMesh {
  std::vector<Vec3> points;
  std::vector<Tetrahedron> tetrahedra;
};

/// By CGAL's Mesh_3. Throws GeometryError when this build has no CGAL.
RawMesh mesh_with_cgal(const TriangleSurface& surface, const SurfaceFeatures& features, const SurfaceMeshSpec& spec);

/// By the program gmsh, in a folder of temporary files that is gone afterwards. Throws GeometryError when there is no
/// such program, or with what it says when it fails.
RawMesh mesh_with_gmsh(const TriangleSurface& surface, const SurfaceFeatures& features, const SurfaceMeshSpec& spec);

}  // namespace tessera
