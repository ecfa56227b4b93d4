#pragma once

#include "tessera/discretization/discretization.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// Moves the means of cells at free faces of the ghost formulation to their centroids (theory, section 11). There [V 6]
/// gives the stretch in a direction e in the plane of the faces at a point of its own; the mean over the n directions,
///
///     C*_a - X_a = (1/V_a) [ (I - T) u / n + ((n + 1) T u - w / 2) / (n (n + 2)) ] ,
///     u = sum_b (X_ab . T B_ab) X_ab ,   w = sum_b (X_ab . T X_ab) T B_ab ,
///
/// with the projection T onto them, is where F_a belongs. On the way to the centroid F changes by what differences to
/// neighbours say: the cell's own along the faces, those of the neighbour behind across them. Cells with prescribed
/// faces and those inside stay as they are. Needs the measure.
MovedMeans moved_means(const Discretization& d, const Cells& cells);

}  // namespace tessera
