#pragma once

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// A force given from outside on one particle [N].
struct NodalForce {
  Index particle = 0;
  Vec3 force;
};

}  // namespace tessera
