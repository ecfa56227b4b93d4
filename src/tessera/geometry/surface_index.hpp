#pragma once

#include <array>
#include <utility>
#include <vector>

#include "tessera/geometry/bounding_tree.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

enum class Location { outside, on_surface, inside };

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
  int winding(const Vec3& X) const {
    return winding_of(X, [](Index) { return true; });
  }
  /// The same of those triangles t alone for which takes(t) holds; together they have to be closed.
  template <class Takes>
  int winding_of(const Vec3& X, Takes&& takes) const {
    int turns = 0;
    tree_.visit([&](const Bounds& box) { return is_above(box, X); },
                [&](Index t) {
                  if (takes(t)) turns += crossing(surface_.corners(t), X);
                });
    return turns;
  }
  /// Where X is; exact, also on faces, edges and vertices.
  Location location(const Vec3& X) const;
  /// Is X inside or on the surface?
  bool contains(const Vec3& X) const { return location(X) != Location::outside; }

  /// The nearest point of the surface; its triangle is one of those that are nearest.
  NearestPoint nearest(const Vec3& X) const;
  /// Is X nearer to the surface than `distance` [m]? Much faster than nearest() where it is not.
  bool is_nearer_than(double distance, const Vec3& X) const;

 private:
  /// Can a ray upwards from X meet the box?
  static bool is_above(const Bounds& box, const Vec3& X) {
    return box.lower.x <= X.x && X.x <= box.upper.x && box.lower.y <= X.y && X.y <= box.upper.y && X.z <= box.upper.z;
  }
  /// +1 (-1) when the ray upwards from X leaves (enters) the solid through a triangle, 0 when it misses it.
  static int crossing(const std::array<Vec3, 3>& corners, const Vec3& X);

  /// The nearest triangle whose squared distance from X is below `distance2`, and that; -1 when there is none.
  std::pair<Index, double> nearest_below(double distance2, const Vec3& X) const;

  const TriangleSurface& surface_;
  BoundingTree tree_;
};

/// The point of the triangle a, b, c that is nearest to X.
Vec3 nearest_on_triangle(const Vec3& X, const Vec3& a, const Vec3& b, const Vec3& c);

/// Is X, which lies in the plane of the triangle a, b, c, in it or on its boundary? Exact; the triangle has an area.
bool in_triangle(const Vec3& X, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace tessera
