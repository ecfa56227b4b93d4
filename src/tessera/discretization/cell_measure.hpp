#pragma once

#include "tessera/discretization/discretization.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// Of Voronoi cells, which need their second moments: F_a is the mean over the cell.
CellMeasure measure_of_cells(const Cells& cells);

/// Of the barycentric dual cells of a mesh's vertices: of every tetrahedron the quarter that is nearer to the vertex
/// than to the others, in barycentric coordinates. As F is constant in a tetrahedron, F_a = sum_t vol_t/4 F_t / V_a is
/// the mean over this cell.
CellMeasure measure_of_dual_cells(const TetrahedralMesh& mesh);

/// The symmetric root of three times the second moment, per volume: its columns, and their opposites, are the places of
/// six points about the centroid, each with a sixth of the volume, that have the cell's second moment [m].
Mat3 cubature_points(const Symmetric3& second_moment);

/// How F varies within the cells, from its differences to the neighbours with a common face: the derivatives fit them
/// best with weights 1/r^2 (r between centroids), exactly where F is linear. With G_a = sum_b (F_b - F_a) (x) C_ab /
/// r^2 they are the columns of G_a K_a^-1, K_a = sum_b C_ab (x) C_ab / r^2.
struct CellGradients {
  /// K_a^-1 p_a with the places p_a of the cubature points: columns of G_a times it are F there, less F_a [m].
  std::vector<Mat3> to_points;
  Index unresolved = 0;  // cells that have no neighbours in some direction, along which F counts as constant
};

/// The derivative along v that this fit has in cell a: the sum of weight F over the terms, the cell itself included.
std::vector<MeanTerm> derivative(const Discretization& d, Index a, const Vec3& v);

/// Needs the measure and the bonds.
CellGradients cell_gradients(const Discretization& d);

}  // namespace tessera
