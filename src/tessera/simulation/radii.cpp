#include "tessera/simulation/radii.hpp"

#include <fmt/format.h>

namespace tessera {

void set_radii(const MethodSpec& method, const ParticleSpec& spec, PointSet& points) {
  if (spec.radius && !points.radius.empty())
    throw InputError(spec.origin,
                     "the file has a column radius, and the key radius is given too; take out one of them");
  if (spec.radius)
    for (const Vec3& X : points.points) {
      points.radius.push_back((*spec.radius)(0.0, X));
      if (!(points.radius.back() >= 0.0))
        throw InputError(
            spec.origin,
            fmt::format("radius = \"{}\" gives {:g} m for particle {} at ({:g}, {:g}, {:g}) m; radii must not "
                        "be negative",
                        spec.radius->text(), points.radius.back(), points.radius.size() - 1, X.x, X.y, X.z));
    }
  if (points.radius.empty() || method.formulation == Formulation::delaunay ||
      method.boundary == BoundaryTreatment::consistent)
    return;
  throw InputError(
      spec.origin,
      "particles with radii have power cells, whose faces do not bisect the branches; only method.boundary = "
      "\"consistent\" is made for them, the ghosts of \"variational\" and \"quasi-static\" are not");
}

std::vector<double> power_weights(const PointSet& points, const std::vector<Index>& order) {
  std::vector<double> weights;
  if (points.radius.empty()) return weights;
  for (const Index p : order) {
    const double r = points.radius[static_cast<std::size_t>(p)];
    weights.push_back(r * r);
  }
  return weights;
}

}  // namespace tessera
