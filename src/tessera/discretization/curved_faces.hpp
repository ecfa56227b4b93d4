#pragma once

#include <span>

#include "tessera/base/csr.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/discretization/face_positions.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// What makes faces exact for quadratic motion, and the boundary faces' positions with it.
///
/// Second derivatives add H_f : M_f to c_f, with M_f = (S_f - sum_c phi_fc Y_c (x) Y_c) / 2: S_f is the face's mean of
/// Y (x) Y, Y_c are the particles of its stencil, both about the middle of the branch, or about the owner of a boundary
/// face. H_f is the weighted mean of both cells', or the owner's mean one. Faces of cells whose quadratics are not
/// resolved stay as they are.
struct CurvedFaces {
  SecondOrder second_order;
  Csr<FaceTerm> boundary;  // c_f as sums over particles, as FacePositions::boundary
};

/// The points whose mean is that over a flat face of this area [m2] and second moment (integral, about its centroid
/// [m4]).
FaceSpread face_spread(const Symmetric3& second_moment, double area);

/// `cells` must have the second moments of faces, `d` its bonds and the measure of its cells; `D` holds one projection
/// per boundary face.
CurvedFaces curved_faces(const Discretization& d, const Cells& cells, const Csr<FaceOfCell>& faces,
                         const FacePositions& positions, std::span<const Mat3> D);

}  // namespace tessera
