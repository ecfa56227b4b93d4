#include "tessera/simulation/overlap.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/geometry/solid_surface.hpp"
#include "tessera/geometry/surface_overlap.hpp"
#include "tessera/tessellation/clip.hpp"

namespace tessera {

namespace {

bool boxes_meet(const Vec3& lower_a, const Vec3& upper_a, const Vec3& lower_b, const Vec3& upper_b, double slack) {
  for (int i = 0; i < 3; ++i)
    if (std::min(upper_a[i], upper_b[i]) - std::max(lower_a[i], lower_b[i]) <= slack) return false;
  return true;
}

/// The box as a polyhedron, a start for clipping.
ConvexPolyhedron box_polyhedron(const Vec3& lower, const Vec3& upper) {
  ConvexPolyhedron p;
  for (int i = 0; i < 8; ++i)
    p.vertices.push_back({(i & 1) ? upper.x : lower.x, (i & 2) ? upper.y : lower.y, (i & 4) ? upper.z : lower.z});
  for (const auto& face :
       {std::array<Index, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    p.corners.insert(p.corners.end(), face.begin(), face.end());
    p.close_face(-1);
  }
  return p;
}

bool pieces_meet(const ConvexPiece& a, const ConvexPiece& b, double slack) {
  if (!boxes_meet(a.lower, a.upper, b.lower, b.upper, slack)) return false;
  ConvexPolyhedron common = box_polyhedron(a.lower, a.upper);
  Clipper clipper(slack);
  for (const ConvexPiece* piece : {&a, &b})
    for (const ConvexPiece::Wall& wall : piece->walls)
      if (clipper.clip(common, wall.plane, -1) == Clipper::Outcome::emptied) return false;
  return !common.is_empty();
}

bool pieces_meet(const Solid& a, const Solid& b, double slack) {
  for (const ConvexPiece& p : a.pieces)
    for (const ConvexPiece& q : b.pieces)
      if (pieces_meet(p, q, slack)) return true;
  return false;
}

bool surfaces_meet(const BuiltBody& a, const BuiltBody& b, double slack) {
  const TriangleSurface of_a = a.solid ? surface_of(*a.solid) : *a.outline,
                        of_b = b.solid ? surface_of(*b.solid) : *b.outline;
  const SurfaceIndex index_a(of_a), index_b(of_b);
  return find_overlap({index_a, a.d.X}, {index_b, b.d.X}, slack).has_value();
}

bool bodies_meet(const BuiltBody& a, const BuiltBody& b) {
  const double slack = 1e-9 * norm(a.surface.upper - a.surface.lower);
  if (!boxes_meet(a.surface.lower, a.surface.upper, b.surface.lower, b.surface.upper, slack)) return false;
  return a.solid && b.solid ? pieces_meet(*a.solid, *b.solid, slack) : surfaces_meet(a, b, slack);
}

}  // namespace

void refuse_overlap(const std::vector<BodySpec>& specs, const std::vector<BuiltBody>& bodies) {
  for (std::size_t j = 1; j < bodies.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (bodies_meet(bodies[i], bodies[j]))
        throw InputError(specs[j].origin,
                         fmt::format("body \"{}\" overlaps body \"{}\"; bodies do not feel each other yet, so keep "
                                     "them apart or make them one shape (union)",
                                     specs[j].name, specs[i].name));
}

}  // namespace tessera
