#pragma once

#include <vector>

#include "tessera/geometry/bounding_tree.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

enum class Placement { outside, on_surface, inside };

/// The point of a surface that is nearest to another point.
struct NearestPoint {
  Index triangle = -1;
  Vec3 X;                 // [m]
  double distance = 0.0;  // [m]
};

/// Answers questions about a closed surface fast. Keeps a reference: the surface must outlive it and stay as it is.
/// Any number of threads may ask at once.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const TriangleSurface& surface);

  const TriangleSurface& surface() const { return surface_; }

  /// Replaces `found` by the triangles whose boxes meet `box`, ascending.
  void triangles_near(const Bounds& box, std::vector<Index>& found) const;
  /// Calls found(t) for every triangle whose box meets `box`, in an order that depends on the surface only.
  template <class Found>
  void for_each_near(const Bounds& box, Found&& found) const {
    tree_.visit([&](const Bounds& node) { return node.meets(box); },
                [&](Index t) {
                  if (bounds(surface_, t).meets(box)) found(t);
                });
  }

  /// How often the surface winds around X: 1 in the solid, 0 outside, -1 inside a surface that is inside out. Exact
  /// for every X that is not on the surface; there it is that of a point infinitely near, above X.
  int winding(const Vec3& X) const;
  /// Where X is; exact, also on faces, edges and vertices.
  Placement placement(const Vec3& X) const;
  /// Is X inside or on the surface?
  bool contains(const Vec3& X) const { return placement(X) != Placement::outside; }

  /// The nearest point of the surface; its triangle is one of those that are nearest.
  NearestPoint nearest(const Vec3& X) const;

 private:
  const TriangleSurface& surface_;
  BoundingTree tree_;
};

/// The point of the triangle a, b, c that is nearest to X.
Vec3 nearest_on_triangle(const Vec3& X, const Vec3& a, const Vec3& b, const Vec3& c);

/// Is X, which lies in the plane of the triangle a, b, c, in it or on its boundary? Exact; the triangle has an area.
bool in_triangle(const Vec3& X, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace tessera
