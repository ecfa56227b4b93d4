#include "tessera/geometry/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mpzf.h>

#include <array>

#ifndef CGAL_HAS_THREADS
#error "CGAL's exact predicates must be safe to call from several threads"
#endif

namespace tessera::exact {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  return CGAL::orientation(point(a), point(b), point(c), point(d));
}

int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const auto point = [axis](const Vec3& p) { return Kernel::Point_2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
  return CGAL::orientation(point(a), point(b), point(c));
}

int side_of_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  return CGAL::side_of_oriented_sphere(point(a), point(b), point(c), point(d), point(e));
}

}  // namespace tessera::exact

namespace tessera {
namespace {

/// Sums and products of floating-point numbers without round-off.
using Number = CGAL::Mpzf;
using Vector = std::array<Number, 3>;

Vector difference(const Vec3& b, const Vec3& a) {
  return {Number(b.x) - Number(a.x), Number(b.y) - Number(a.y), Number(b.z) - Number(a.z)};
}

Number cross_component(const Vector& u, const Vector& v, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  return u[i] * v[j] - u[j] * v[i];
}

}  // namespace

int side_of_power_sphere(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, const WeightedPoint& d,
                         const WeightedPoint& e) {
  using Kernel = exact::Kernel;
  const auto point = [](const WeightedPoint& p) {
    return Kernel::Weighted_point_3(Kernel::Point_3(p.X.x, p.X.y, p.X.z), p.weight);
  };
  return CGAL::power_side_of_oriented_power_sphere(point(a), point(b), point(c), point(d), point(e));
}

int cross_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int axis) {
  return CGAL::sign(cross_component(difference(b, a), difference(d, c), static_cast<std::size_t>(axis)));
}

double crossing_fraction(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, const Vec3& q) {
  const Vector ab = difference(b, a), ac = difference(c, a), ap = difference(p, a), pq = difference(q, p);
  Number height(0), rise(0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Number normal = cross_component(ab, ac, axis);
    height = height + normal * ap[axis];
    rise = rise + normal * pq[axis];
  }
  return CGAL::to_double(-height) / CGAL::to_double(rise);
}

}  // namespace tessera
