#include "tessera/geometry/surface_overlap.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "tessera/geometry/triangle_meeting.hpp"

namespace tessera {
namespace {

Bounds common(const Bounds& a, const Bounds& b) {
  Bounds box;
  for (int d = 0; d < 3; ++d) {
    box.lower[d] = std::max(a.lower[d], b.lower[d]);
    box.upper[d] = std::min(a.upper[d], b.upper[d]);
  }
  return box;
}

bool is_deep_inside(const SurfaceIndex& index, const Vec3& X, double slack) {
  return index.location(X) == Location::inside && index.nearest(X).distance > slack;
}

/// A point of the edge p q deep inside the solid that the surface bounds: between two crossings it is all inside or all
/// outside.
std::optional<Vec3> deep_on_edge(const SurfaceIndex& index, const Vec3& p, const Vec3& q, double slack) {
  Bounds box;
  box.include(p);
  box.include(q);
  std::vector<double> crossings{0.0, 1.0};
  index.for_each_near(box, [&](Index t) {
    const auto [a, b, c] = index.surface().corners(t);
    const Vec3 normal = area_vector(index.surface(), t);
    const double at_p = dot(normal, p - a), at_q = dot(normal, q - a);
    if (at_p * at_q < 0.0 && segment_meets_triangle(p, q, a, b, c)) crossings.push_back(at_p / (at_p - at_q));
  });
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const Vec3 X = p + 0.5 * (crossings[i - 1] + crossings[i]) * (q - p);
    if (is_deep_inside(index, X, slack)) return X;
  }
  return std::nullopt;
}

/// Of the two triangles at an edge only one needs to look along it.
bool is_first(const Vec3& p, const Vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

std::optional<Vec3> find_in(const FilledSurface& a, const SurfaceIndex& b, const Bounds& box, double slack) {
  std::optional<Vec3> found;
  const auto look_at = [&](const Vec3& X) {
    if (!found && box.contains(X) && is_deep_inside(b, X, slack)) found = X;
  };
  a.index.for_each_near(box, [&](Index t) {
    if (found) return;
    const auto corners = a.index.surface().corners(t);
    look_at((corners[0] + corners[1] + corners[2]) / 3.0);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &p = corners[i], &q = corners[(i + 1) % 3];
      look_at(p);
      if (!found && is_first(p, q)) found = deep_on_edge(b, p, q, slack);
    }
  });
  for (const Vec3& X : a.points) look_at(X);
  return found;
}

}  // namespace

std::optional<Vec3> find_overlap(const FilledSurface& a, const FilledSurface& b, double slack) {
  const Bounds box = common(bounds(a.index.surface()), bounds(b.index.surface()));
  for (int d = 0; d < 3; ++d)
    if (box.upper[d] - box.lower[d] <= slack) return std::nullopt;
  if (const auto X = find_in(a, b.index, box, slack)) return X;
  return find_in(b, a.index, box, slack);
}

}  // namespace tessera
