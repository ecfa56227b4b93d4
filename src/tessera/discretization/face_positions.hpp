#pragma once

#include <span>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/base/mat3.hpp"
#include "tessera/discretization/stencil.hpp"
#include "tessera/discretization/voronoi_common.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/generators.hpp"

namespace tessera {

/// One particle's share in the position of a face, c_f = sum_k weight_k x_k.
struct FaceTerm {
  Index particle = 0;
  double weight = 0.0;
};

/// Positions of all faces, in the order of Cells::interior and Cells::boundary.
///
/// An interior face has c_f = (1 - s) x_a + s x_b + sum_c w_c x_c over its stencil: a, b and their common neighbours;
/// if it is widened, a, b and all neighbours of both. s is branch_share(face): 1/2 but for power cells. w_c is the
/// value of the face's function at X_c - (1 - s) X_a - s X_b.
struct FacePositions {
  std::vector<StencilFunction> interior;
  std::vector<char> is_widened;         // of interior faces: 0 or 1
  Csr<FaceTerm> boundary;               // empty for faces that are wholly prescribed; else the free components
  std::vector<Index> widened_boundary;  // faces whose stencil reaches beyond the nearest neighbours
};

/// The places, in the first of two lists of faces of cells, of the neighbours that both have.
class CommonNeighbours {
 public:
  std::span<const Index> find(std::span<const FaceOfCell> of_a, std::span<const FaceOfCell> of_b) {
    if (places_.size() <= of_a.size()) places_.resize(of_a.size() + 1);
    std::size_t i = 0, j = 0, n = 0;
    while (i < of_a.size() && j < of_b.size()) {  // without branches that depend on the lists
      const Index c = of_a[i].neighbour, d = of_b[j].neighbour;
      places_[n] = static_cast<Index>(i);
      n += c == d;
      i += c <= d;
      j += d <= c;
    }
    return {places_.data(), n};
  }

 private:
  std::vector<Index> places_;
};

/// The positions of the consistent formulation: exact for linear motion, from the nearest particles. `D` holds one
/// projection per boundary face. Throws GeometryError that names particles whose neighbours lie in a plane or line.
FacePositions face_positions(const Generators& X, const Cells& cells, const Csr<FaceOfCell>& faces,
                             std::span<const Mat3> D);

}  // namespace tessera
