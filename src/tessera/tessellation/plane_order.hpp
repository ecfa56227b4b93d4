#pragma once

#include <tuple>

#include "tessera/geometry/solid.hpp"

namespace tessera {

/// Of the two ways a plane can face, every plane has one that is forward: the first component of its normal that is not
/// zero is positive.
inline bool faces_forward(const Plane& plane) {
  const Vec3& n = plane.normal;
  return (n.x != 0.0 ? n.x : (n.y != 0.0 ? n.y : n.z)) > 0.0;
}

inline Plane forward(const Plane& plane) { return faces_forward(plane) ? plane : Plane{-plane.normal, -plane.offset}; }

/// An order of planes that does not depend on which way they face.
inline bool comes_before(const Plane& a, const Plane& b) {
  const Plane p = forward(a), q = forward(b);
  return std::tie(p.normal.x, p.normal.y, p.normal.z, p.offset) <
         std::tie(q.normal.x, q.normal.y, q.normal.z, q.offset);
}

}  // namespace tessera
