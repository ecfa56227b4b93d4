#include "tessera/simulation/inertia.hpp"

#include <algorithm>

namespace tessera {

State initial_state(const Model& model) {
  State state = reference_state(model.system);
  for (std::size_t a = 0; a < model.initial_displacement.size(); ++a) {
    state.x[a] += to_kernel(model.initial_displacement[a]);
    state.v[a] = to_kernel(model.initial_velocity[a]);
  }
  return state;
}

std::optional<MassScaling> scaled_mass(const Model& model, const TimeSpec& spec, const State& state) {
  if (!spec.mass_scaling) return std::nullopt;
  const auto at_rest = [](const Vec3& v) { return v == Vec3{}; };
  if (!std::all_of(model.initial_velocity.begin(), model.initial_velocity.end(), at_rest))
    throw InputError(spec.mass_scaling->origin,
                     "bodies with an initial velocity would move with a wrong momentum; mass scaling is for slow "
                     "loading from rest, so take out the velocity or the scaling");
  if (!has_potential(model.system.d))
    throw InputError(spec.mass_scaling->origin,
                     "needs forces with a potential; boundary = \"consistent\" has them, \"quasi-static\" has not, nor "
                     "\"variational\" with prescribed faces");
  return scale_mass(model.system, state, model.loads.motion.positions(), spec.mass_scaling->step, spec.safety);
}

}  // namespace tessera
