#pragma once

#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/simulation/case.hpp"

namespace tessera {

/// The particles of a body: cell centres or vertices, as the formulation wants them; in two dimensions one layer of
/// cells.
PointSet points_of(const Case& c, const BodySpec& body, const Solid& solid);

}  // namespace tessera
