#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

Bounds bounds(const TriangleSurface& surface) {
  Bounds box;
  for (Index t = 0; t < surface.size(); ++t) box.include(bounds(surface, t));
  return box;
}

Bounds bounds(const TriangleSurface& surface, Index t) {
  Bounds box;
  for (const Vec3& corner : surface.corners(t)) box.include(corner);
  return box;
}

Vec3 area_vector(const TriangleSurface& surface, Index t) {
  const auto [a, b, c] = surface.corners(t);
  return 0.5 * cross(b - a, c - a);
}

double area(const TriangleSurface& surface) {
  double sum = 0.0;
  for (Index t = 0; t < surface.size(); ++t) sum += norm(area_vector(surface, t));
  return sum;
}

double volume(const TriangleSurface& surface) {
  if (surface.triangles.empty()) return 0.0;
  const Vec3 origin = surface.corners(0)[0];  // near the surface, so that little cancels
  double six_volumes = 0.0;
  for (Index t = 0; t < surface.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    six_volumes += dot(a - origin, cross(b - origin, c - origin));
  }
  return six_volumes / 6.0;
}

}  // namespace tessera
