#pragma once

#include "tessera/geometry/shape_surface.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/loads/surface.hpp"
#include "tessera/simulation/case.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// The pieces of a body's surface that conditions name: boundary faces of Voronoi cells in a solid ...
Surface surface_of_body(const BodySpec& body, const Solid& solid, const Cells& cells);
/// ... or within a closed surface, ...
Surface surface_of_body(const BodySpec& body, const ShapeSurface& shape, const Cells& cells);
/// ... or the outer triangles of tetrahedra.
Surface surface_of_body(const BodySpec& body, const TetrahedralMesh& mesh);

/// The outer triangles of a mesh as a surface of their own.
TriangleSurface outline_of(const TetrahedralMesh& mesh);

}  // namespace tessera
