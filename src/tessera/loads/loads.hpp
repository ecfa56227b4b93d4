#pragma once

#include "tessera/loads/prescribed_motion.hpp"
#include "tessera/loads/tractions.hpp"

namespace tessera {

/// Everything that acts on a system from outside.
struct Loads {
  PrescribedMotion motion;  // of the boundary nodes' walls (voronoi) or of the constrained particles (delaunay)
  Tractions tractions;
  Vec3 gravity;  // [m/s2]
};

}  // namespace tessera
