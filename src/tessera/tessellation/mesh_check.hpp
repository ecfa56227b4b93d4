#pragma once

#include <vector>

#include "tessera/geometry/mesh_file.hpp"
#include "tessera/tessellation/mesh_faces.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// The mesh that a file describes, checked: finite points, each used and none doubled; tetrahedra neither inverted nor
/// flat, each face between at most two of them and each edge of the boundary between two boundary triangles; every
/// named triangle is a face. Throws GeometryError with file, place, the file's own numbers and the cure.
TetrahedralMesh checked_mesh(const FileMesh& file);

/// Throws GeometryError for points that are not finite, belong to no tetrahedron, or lie within 1e-9 of the mesh's
/// size of another.
void refuse_bad_points(const FileMesh& file);

/// Throws GeometryError for tetrahedra with a vertex twice, inverted ones and flat ones (volume below 1e-12 of the
/// longest edge cubed).
void refuse_bad_tetrahedra(const FileMesh& file);

/// The outer faces, sorted. Throws GeometryError for faces that more than two tetrahedra use, or two on the same side,
/// and for edges of the boundary that do not lie between exactly two boundary triangles.
std::vector<Triangle> closed_boundary(const FileMesh& file);

/// Puts the file's named triangles on the mesh's boundary and names its sides; a triangle of several surfaces lies on a
/// side with several names. Named triangles inside the body are left out. Throws GeometryError for one that is no
/// face of a tetrahedron.
void name_sides(const FileMesh& file, TetrahedralMesh& mesh);

}  // namespace tessera
