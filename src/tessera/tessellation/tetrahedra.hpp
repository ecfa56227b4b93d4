#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/solid.hpp"

namespace tessera {

/// A triangle of a mesh's boundary, vertices counter-clockwise seen from outside.
struct BoundaryTriangle {
  std::array<Index, 3> vertices{};
  Index side = -1;  // index into TetrahedralMesh::side_names, -1 where the mesh names no surface
};

/// Conforming tetrahedra with positive volumes that fill a body; particles are the vertices.
struct TetrahedralMesh {
  std::vector<Vec3> points;
  std::vector<std::array<Index, 4>> tetrahedra;      // sorted; det(X1-X0, X2-X0, X3-X0) > 0
  std::vector<BoundaryTriangle> boundary;            // sorted by vertices
  std::vector<std::vector<std::string>> side_names;  // a side may have several names
};

/// How tetrahedra are made from points: by CGAL, by splitting the lattice's cells, or by CGAL where it is built in.
enum class Tetrahedralization { automatic, delaunay, split };

/// True when this build can compute Delaunay tetrahedra of arbitrary points (CGAL).
bool has_delaunay();

/// Fills `solid` with tetrahedra on the vertices `points`. A regular axis-parallel lattice gives the same tetrahedra
/// both ways. Points with radii get the regular triangulation, the dual of their power cells, which needs CGAL; an
/// empty power cell is an error that names the particle. Throws GeometryError when the tetrahedra do not fill the solid
/// (its volume is compared), when a split lattice would invert one (names it), when points are left without a
/// tetrahedron, or when the way asked for is not available.
TetrahedralMesh tetrahedralize(const PointSet& points, const Solid& solid, Tetrahedralization how);

/// Reads a Gmsh .msh (2.2 and 4.1, ASCII and binary) or VTK .vtu (ASCII, base64, appended; zlib) file.
/// Surfaces that the file names (physical groups; in .vtu none) become sides. Throws GeometryError with file and
/// line or offset for unreadable, truncated or unsupported files, inverted or flat elements, isolated or doubled
/// vertices.
TetrahedralMesh read_mesh(const std::string& path);

}  // namespace tessera
