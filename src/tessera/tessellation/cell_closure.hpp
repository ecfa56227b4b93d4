#pragma once

#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/generators.hpp"

namespace tessera {

/// Round-off of coordinates in a cell of volume V around X [m].
double round_off(const Vec3& X, double V);

/// Takes the volumes from the faces by the divergence theorem, so that they fit each other to the last digit. Throws
/// GeometryError that names the particle of a cell that is not closed, or thinner than round-off.
void close_cells(const Generators& points, Cells& cells);

}  // namespace tessera
