#pragma once

#include <array>
#include <string>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/geometry/bounds.hpp"

namespace tessera {

/// Numbers of three vertices.
using Triangle = std::array<Index, 3>;

/// The boundary of a solid as triangles that share their vertices. What the checks of surface_check.hpp let pass is
/// closed (every edge lies between as many triangles that run along it as against it), oriented, free of triangles
/// without area, and meets itself at common edges and vertices only.
struct TriangleSurface {
  std::vector<Vec3> vertices;           // [m], no two in one place
  std::vector<Triangle> triangles;      // counter-clockwise seen from outside the solid
  std::vector<Index> side;              // per triangle: index into side_names
  std::vector<std::string> side_names;  // each once

  Index size() const { return static_cast<Index>(triangles.size()); }
  const Vec3& vertex(Index v) const { return vertices[static_cast<std::size_t>(v)]; }
  const Triangle& triangle(Index t) const { return triangles[static_cast<std::size_t>(t)]; }
  /// The corners of triangle t, in its order.
  std::array<Vec3, 3> corners(Index t) const {
    const Triangle& v = triangle(t);
    return {vertex(v[0]), vertex(v[1]), vertex(v[2])};
  }
};

/// The box around all vertices that triangles use.
Bounds bounds(const TriangleSurface& surface);

/// The box around triangle t.
Bounds bounds(const TriangleSurface& surface, Index t);

/// Half the cross product of two edges of triangle t: its area times the outward normal [m2].
Vec3 area_vector(const TriangleSurface& surface, Index t);

/// Area of all triangles [m2].
double area(const TriangleSurface& surface);

/// The volume that a closed surface encloses, by the divergence theorem [m3]; negative when it is inside out.
double volume(const TriangleSurface& surface);

}  // namespace tessera
