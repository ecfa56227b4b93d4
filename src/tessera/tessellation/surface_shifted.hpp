#pragma once

#include "tessera/base/vec3.hpp"

namespace tessera {

/// Signs for crossings of Voronoi cells with a surface, never zero where it matters: they are those of cells that are
/// moved against the surface by (e, e^2, e^3) with e > 0 as small as need be. Then no corner of a cell lies on a
/// triangle, no vertex of the surface on a face, and edges do not meet, so that all that cells and surface have in
/// common are edges through triangles; and all cells agree on these. Points called v belong to cells, those called u
/// to the surface.
namespace shifted {

/// Is v above (+1) or below (-1) the plane of the triangle? Above is where it runs counter-clockwise.
int above_triangle(const Vec3& u0, const Vec3& u1, const Vec3& u2, const Vec3& v);

/// The same for a triangle of a cell's face. 0 when it has no area.
int above_face(const Vec3& v0, const Vec3& v1, const Vec3& v2, const Vec3& u);

/// orient3d(v0, v1, u0, u1): which way the lines v0 v1 and u0 u1 pass each other. 0 when they are parallel.
int passes(const Vec3& v0, const Vec3& v1, const Vec3& u0, const Vec3& u1);

/// orient3d(v0, u, v1, v2): the same for a line from a point of the cell to one of the surface, and one of the cell.
int passes_ray(const Vec3& v0, const Vec3& u, const Vec3& v1, const Vec3& v2);

}  // namespace shifted
}  // namespace tessera
