#pragma once

#include <optional>

#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// Does the segment p q, closed, meet the closed triangle a b c, which has an area? Exact.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

/// Do two triangles with areas meet anywhere but at the vertices and the edge that they share? Exact.
bool meet_wrongly(const TriangleSurface& surface, Index s, Index t);

/// A pair of triangles that meet wrongly, and how many such pairs there are.
struct WrongMeeting {
  Index s = 0, t = 0;  // the first pair: least s, then least t > s
  Index pairs = 0;
};

/// Looks for triangles that meet anywhere but at vertices and edges that they share; in parallel, n log n time.
std::optional<WrongMeeting> find_wrong_meeting(const TriangleSurface& surface);

}  // namespace tessera
