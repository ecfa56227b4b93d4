#include "tessera/simulation/relaxed_points.hpp"

#include <fmt/format.h>

#include "tessera/tessellation/relax.hpp"

namespace tessera {

namespace {

std::string describe(const BodySpec& body, const RelaxedSpec& spec, const Relaxed& relaxed) {
  return fmt::format(
      "particles of body \"{}\": relaxed {} times; they are {:.2g} spacings away from the centroids of their cells "
      "(root "
      "mean square), {} the tolerance of {:g}",
      body.name, relaxed.iterations, relaxed.distance, relaxed.distance <= spec.tolerance ? "within" : "which is above",
      spec.tolerance);
}

template <class Relax>
void relax_with(const BodySpec& body, std::vector<Vec3>& points, std::vector<std::string>& notes, Relax&& relax) {
  const auto* spec = std::get_if<RelaxedSpec>(&body.particles.source);
  if (spec == nullptr) return;
  Relaxed relaxed = relax(*spec);
  points = std::move(relaxed.points);
  notes.push_back(describe(body, *spec, relaxed));
}

}  // namespace

void relax_points(const BodySpec& body, const Solid& solid, std::vector<Vec3>& points,
                  std::vector<std::string>& notes) {
  relax_with(body, points, notes,
             [&](const RelaxedSpec& spec) { return relax(std::move(points), solid, spec, body.particles.dimension); });
}

void relax_points(const BodySpec& body, const SurfaceIndex& index, std::vector<Vec3>& points,
                  std::vector<std::string>& notes) {
  relax_with(body, points, notes, [&](const RelaxedSpec& spec) { return relax(std::move(points), index, spec); });
}

}  // namespace tessera
