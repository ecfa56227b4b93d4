#pragma once

#include <string>
#include <vector>

#include "tessera/simulation/body_builder.hpp"

namespace tessera {

/// Throws InputError when two bodies share volume: bodies do not touch each other yet. Bodies from mesh files are
/// compared by their bounding boxes.
void refuse_overlap(const std::vector<BodySpec>& specs, const std::vector<BuiltBody>& bodies);

}  // namespace tessera
