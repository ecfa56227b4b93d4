#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// A particle as the user finds it.
struct PlacedParticle {
  std::string body;
  std::int64_t particle = 0;  // its number in that body
  Vec3 X;                     // [m]
};

/// How well particles and cells are shaped for a run.
struct Quality {
  double smallest_volume = 0.0, mean_volume = 0.0, largest_volume = 0.0;  // [m3]
  std::int64_t fewest_faces = 0, most_faces = 0;                          // per cell; in delaunay, bonds per particle
  double mean_faces = 0.0;
  double shortest_bond = 0.0, typical_bond = 0.0;  // [m]; the latter the median of all particles' shortest ones
  PlacedParticle at_shortest_bond;

  /// The step that a particle asks for, sqrt(V_a / k_a) with the stiffness k_a of its own motion, as a share of the
  /// median of all.
  struct Step {
    PlacedParticle at;
    double share = 1.0;
  };
  std::vector<Step> shortest_steps;  // ascending, a few
  std::int64_t few = 0;              // particles that shorten the step of all others, as so few need not; else 0
};

/// Lines for people, the last of them a warning with a cure where a few particles shorten the step.
std::string to_text(const Quality& quality);
nlohmann::ordered_json to_json(const Quality& quality);

}  // namespace tessera
