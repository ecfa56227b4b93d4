#include "tessera/simulation/overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

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

/// The middle of what two pieces have in common; nothing where that is no thicker than `slack`.
std::optional<Vec3> overlap_of(const ConvexPiece& a, const ConvexPiece& b, double slack) {
  if (!boxes_meet(a.lower, a.upper, b.lower, b.upper, slack)) return std::nullopt;
  ConvexPolyhedron common = box_polyhedron(a.lower, a.upper);
  Clipper clipper(slack);
  for (const ConvexPiece* piece : {&a, &b})
    for (const ConvexPiece::Wall& wall : piece->walls)
      if (clipper.clip(common, wall.plane, -1) == Clipper::Outcome::emptied) return std::nullopt;
  if (common.is_empty()) return std::nullopt;
  Vec3 sum;
  for (const Vec3& X : common.vertices) sum += X;
  return sum / static_cast<double>(common.vertices.size());
}

std::optional<Vec3> overlap_of(const Solid& a, const Solid& b, double slack) {
  for (const ConvexPiece& p : a.pieces)
    for (const ConvexPiece& q : b.pieces)
      if (const auto X = overlap_of(p, q, slack)) return X;
  return std::nullopt;
}

std::optional<Vec3> overlap_of_surfaces(const BuiltBody& a, const BuiltBody& b, double slack) {
  const TriangleSurface of_a = a.solid ? surface_of(*a.solid) : *a.outline,
                        of_b = b.solid ? surface_of(*b.solid) : *b.outline;
  const SurfaceIndex index_a(of_a), index_b(of_b);
  return find_overlap({index_a, a.d.X}, {index_b, b.d.X}, slack);
}

/// A place that is in both bodies.
std::optional<Vec3> overlap_of(const BuiltBody& a, const BuiltBody& b) {
  const double slack = 1e-9 * norm(a.surface.upper - a.surface.lower);
  if (!boxes_meet(a.surface.lower, a.surface.upper, b.surface.lower, b.surface.upper, slack)) return std::nullopt;
  return a.solid && b.solid ? overlap_of(*a.solid, *b.solid, slack) : overlap_of_surfaces(a, b, slack);
}

}  // namespace

void refuse_overlap(const std::vector<BodySpec>& specs, const std::vector<BuiltBody>& bodies) {
  for (std::size_t j = 1; j < bodies.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (const auto X = overlap_of(bodies[i], bodies[j]))
        throw InputError(specs[j].origin,
                         fmt::format("body \"{}\" overlaps body \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m; bodies do not "
                                     "feel each other yet, so keep them apart or make them one shape (union)",
                                     specs[j].name, specs[i].name, X->x, X->y, X->z));
}

}  // namespace tessera
