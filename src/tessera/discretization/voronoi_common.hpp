#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "tessera/discretization/discretization.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// Where on the branch of a face its position starts from, as a fraction of the way from a to b: where the face's plane
/// cuts the branch, but not too near to either end, as weights of a stencil go with distances from there.
inline double branch_share(const InteriorFace& f) { return std::clamp(f.cut, 0.1, 0.9); }

/// That point, the middle of the branch but for power cells.
inline Vec3 on_branch(const InteriorFace& f, const Vec3& X_a, const Vec3& X_b) {
  const double s = branch_share(f);
  return s == 0.5 ? 0.5 * (X_a + X_b) : (1.0 - s) * X_a + s * X_b;
}

/// A cell's face as its particle sees it: the neighbour and the face's number.
struct FaceOfCell {
  Index neighbour = 0;  // -1 on the boundary
  Index face = 0;       // index into Cells::interior or Cells::boundary
};

/// The faces of every cell: interior ones by ascending neighbour, then boundary ones by ascending side.
Csr<FaceOfCell> faces_of_cells(const Cells& cells);

/// The interior ones of a cell's faces.
inline std::span<const FaceOfCell> interior_faces(const Csr<FaceOfCell>& faces, Index a) {
  std::span<const FaceOfCell> row = faces.row(a);
  while (!row.empty() && row.back().neighbour < 0) row = row.first(row.size() - 1);
  return row;
}

/// Has the neighbour behind the i-th of a cell's interior faces another face with it before? Only cells that took over
/// a part of another have several faces, in different planes, with one neighbour.
inline bool is_repeated(std::span<const FaceOfCell> interior, std::size_t i) {
  return i > 0 && interior[i].neighbour == interior[i - 1].neighbour;
}

/// The number of different neighbours.
inline std::size_t count_neighbours(std::span<const FaceOfCell> interior) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < interior.size(); ++i) n += !is_repeated(interior, i);
  return n;
}

/// Fills what all Voronoi formulations share: positions, volumes and one site per boundary face.
void describe_particles(Discretization& d, std::span<const Vec3> X, const Cells& cells);

}  // namespace tessera
