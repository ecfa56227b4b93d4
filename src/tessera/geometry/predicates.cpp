#include "tessera/geometry/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

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

}  // namespace tessera::exact
