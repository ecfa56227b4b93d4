#pragma once

#include <span>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/base/mat3.hpp"
#include "tessera/discretization/voronoi_common.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// One particle's share in the position of a face, c_f = sum_k weight_k x_k.
struct FaceTerm {
  Index particle = 0;
  double weight = 0.0;
};

/// Positions of all faces, one row a face, in the order of Cells::interior and Cells::boundary.
struct FacePositions {
  Csr<FaceTerm> interior;
  Csr<FaceTerm> boundary;               // empty for faces that are wholly prescribed; else the free components
  std::vector<Index> widened_interior;  // faces whose stencil reaches beyond the common nearest neighbours
  std::vector<Index> widened_boundary;
};

/// The positions of the consistent formulation: exact for linear motion, from the nearest particles. `D` holds one
/// projection per boundary face. Throws GeometryError that names particles whose neighbours lie in a plane or line.
FacePositions face_positions(std::span<const Vec3> X, const Cells& cells, const Csr<FaceOfCell>& faces,
                             std::span<const Mat3> D);

}  // namespace tessera
