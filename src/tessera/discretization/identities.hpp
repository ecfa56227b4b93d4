#pragma once

#include <map>
#include <string>

#include "tessera/discretization/discretization.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// The largest violation of each identity of the method, relative to the size of its terms; round-off when all is well.
///   volume        sum V_a = V
///   rows          sum_b B_ab = 0: of the cells' area vectors (voronoi), [D 29], [V 9]
///   columns       sum_a B_ab = what acts through free boundary faces, [D 31], [V 13]; inner particles only for ghosts,
///   whose
///                 condensed vectors break it at free faces
///   duality       sum_b X_ab (x) B_ab = V_a I, [D 33], [V 8]
///   second derivatives  of a quadratic function, by the fits of second-order integration
///   antisymmetry  B_ab = - B_ba unless both are on the boundary, [D 30]; of the normal parts, [V 11] (voronoi)
///   area          A_ab = B_ab - B_ba, [V 11] (voronoi)
/// The last two are those of faces that bisect the branch between their particles.
using Identities = std::map<std::string, double>;

/// `solid_volume` is the volume of the solid that the particles fill [m3].
Identities identities_of_delaunay(const Discretization& d, double solid_volume);
Identities identities_of_voronoi(const Discretization& d, const Cells& cells, double solid_volume);

/// The larger violation of each.
Identities worst_of(const Identities& a, const Identities& b);

/// Throws GeometryError that names the identity when a violation is above 1e-10.
void require(const Identities& identities);

}  // namespace tessera
