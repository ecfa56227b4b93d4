#pragma once

#include <functional>

#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/triangle_surface.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// What a mesh of a surface is to be like.
struct SurfaceMeshSpec {
  double spacing = 0.0;         // edges of about this length [m]
  double feature_angle = 40.0;  // edges where the normal turns by more are kept as they are [degrees]
  Mesher mesher = Mesher::automatic;
  std::function<double(const Vec3&)> size = {};  // local length of edges [m]; empty: the spacing everywhere
};

/// A mesh of what a surface encloses, and how good it is.
struct SurfaceMesh {
  TetrahedralMesh mesh;
  Mesher mesher = Mesher::automatic;  // the one that made it
  double volume = 0.0;                // of the mesh [m3]
  double surface_volume = 0.0;        // inside the surface [m3]
  double smallest_angle = 0.0;        // between two faces of a tetrahedron [degrees]
  double smallest_quality = 0.0;      // of a tetrahedron: 3 inscribed radius / circumscribed radius, 1 when regular
  Index slivers = 0;                  // tetrahedra with an angle below 10 degrees
};

/// True when this build can mesh surfaces itself (CGAL's Mesh_3, GPL).
bool has_cgal_mesher();
/// True when the program gmsh is on the search path.
bool has_gmsh();

/// Fills what a closed surface encloses with conforming tetrahedra, the same on every call: by Delaunay refinement
/// (CGAL's Mesh_3; Jamin, Alliez, Yvinec and Boissonnat, ACM TOMS 41 (2015) 23) or by the program gmsh (Geuzaine and
/// Remacle, Int. J. Numer. Meth. Engng 79 (2009) 1309). Vertices of the boundary lie on the surface; sharp edges and
/// the lines between sides are kept, so plane sides are meshed exactly, curved ones up to a twentieth of the spacing
/// (CGAL) or to chords of about a spacing (gmsh). Triangles of the boundary take the side of the surface's triangle
/// that is nearest. Slivers that remain do no harm to the Delaunay formulation, whose gradients are means over the
/// tetrahedra around a particle, weighted with their volumes. Throws GeometryError when the mesher is missing or fails,
/// when the surface needs a finer spacing (parts are lost, or the volume errs by more than a tenth), or when the mesh
/// would be too large.
SurfaceMesh mesh_surface(const TriangleSurface& surface, const SurfaceMeshSpec& spec);

}  // namespace tessera
