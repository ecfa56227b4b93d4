#pragma once

#include <string>
#include <vector>

#include "tessera/simulation/case.hpp"

namespace tessera {

/// Moves the points of a body to where they come to rest if its particles are relaxed ones, and tells in `notes` how
/// near they came to it; leaves all others as they are.
void relax_points(const BodySpec& body, const Solid& solid, std::vector<Vec3>& points, std::vector<std::string>& notes);
void relax_points(const BodySpec& body, const SurfaceIndex& index, std::vector<Vec3>& points,
                  std::vector<std::string>& notes);

}  // namespace tessera
