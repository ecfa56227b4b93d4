#include "tessera/tessellation/delaunay_weights.hpp"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

bool same(const Plane& a, const Plane& b, double tolerance) {
  return std::abs(std::abs(dot(a.normal, b.normal)) - 1.0) <= 1e-12 &&
         std::abs(std::copysign(1.0, dot(a.normal, b.normal)) * b.offset - a.offset) <= tolerance;
}

std::vector<Plane> planes_of(const Solid& solid, double tolerance) {
  std::vector<Plane> planes;
  for (const Side& side : solid.sides)
    if (std::none_of(planes.begin(), planes.end(), [&](const Plane& p) { return same(p, side.plane, tolerance); }))
      planes.push_back(side.plane);
  return planes;
}

}  // namespace

std::vector<double> boundary_weights(std::span<const Vec3> points, const Solid& solid, double strength) {
  const double tolerance = 1e-9 * norm(solid.upper - solid.lower);
  const std::vector<Plane> planes = planes_of(solid, tolerance);
  const double spacing = std::cbrt(solid.volume / static_cast<double>(points.size()));
  std::vector<double> weights;
  weights.reserve(points.size());
  for (const Vec3& X : points) {
    const auto held =
        std::count_if(planes.begin(), planes.end(), [&](const Plane& p) { return std::abs(p.height(X)) <= tolerance; });
    weights.push_back(strength * spacing * spacing * static_cast<double>(held));
  }
  return weights;
}

}  // namespace tessera
