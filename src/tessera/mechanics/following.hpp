#pragma once

#include "tessera/loads/tractions.hpp"
#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/system.hpp"

namespace tessera {

/// Present area vector of a site's face per reference area: J F^-T N with the mean deformation gradient of the cell
/// (voronoi), or half the cross product of the present edges of the triangle, which is exact (delaunay).
Vec3 present_normal(const System& s, Index site, const Double4* x, const Tensor* F);

/// Adds the pressures that follow the faces to the tractions. `x` are the particles' positions, `F` their deformation
/// gradients.
void follow_faces(const System& s, const Double4* x, const Tensor* F, Tractions& tractions);

}  // namespace tessera
