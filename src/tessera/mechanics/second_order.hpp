#pragma once

#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/discretization/cell_measure.hpp"
#include "tessera/mechanics/hessians.hpp"
#include "tessera/parallel/workspaces.hpp"

namespace tessera {

/// What does not change of second-order integration.
struct SecondOrderSystem {
  /// How much of F_b - F_a a cell's three points see, or of their stresses a neighbour.
  struct GradientTerm {
    Index cell = 0;  // b in `gradients`, number of the unresolved cell in `returned`
    Vec3 weight;
  };

  CurvatureRows rows;
  std::vector<Index> averaged;          // cells that use means, ascending
  std::vector<CurvedSurface> surfaces;  // of cells at free boundaries
  std::vector<Symmetric3> points;       // columns: distances of three cubature points from the centroid [m]
  std::vector<Index> unresolved;        // cells whose points follow from the neighbours' F, ascending
  Csr<GradientTerm> gradients;          // one row for each of them
  std::vector<Index> receivers;         // cells that these rows name, ascending, with one row each
  Csr<GradientTerm> returned;
};

/// Needs the bonds.
SecondOrderSystem second_order_system(const Discretization& d, const Tiles& tiles);

/// What changes with every evaluation.
struct SecondOrderMemory {
  explicit SecondOrderMemory(const System& s);

  Field<Hessian> weighted;         // q_a H_a; when faces are known, their sums where the cell uses the mean
  Field<Hessian> sums;             // those, of such cells only
  Field<Hessian> moments;          // derivatives of the energy with respect to `weighted`, but for faces
  Field<ThreeTensors> unresolved;  // F at three points of each unresolved cell less F_a; later what multiplies it [J]
  Field<ThreeTensors> points;      // the same of all cells where laws see a mean change of volume, else empty
  Field<Tensor> T;                 // complete stresses [Pa]
  mutable parallel::Workspaces<CurvatureScratch> scratch;
};

/// F but for what boundary nodes do, and second derivatives.
void find_strain(const System& s, const Double4* x, SecondOrderMemory& memory, Tensor* F);

/// When F is complete: `unresolved`, from differences of F.
void find_unresolved_strains(const SecondOrderSystem& s, const Tensor* F, SecondOrderMemory& memory);

/// Then `points` of all cells, from H_a where it is resolved.
void find_point_strains(const SecondOrderSystem& s, SecondOrderMemory& memory);

/// When `points` has become what multiplies them in the energy: what that does by the second derivatives.
void take_point_moments(const SecondOrderSystem& s, SecondOrderMemory& memory);

/// When all those are: adds to T what unresolved cells do to their neighbours.
void return_gradients(const SecondOrderSystem& s, const double* volume, SecondOrderMemory& memory);

/// When T is complete: adds what free boundary faces do to the derivatives of the energy in `weighted`.
void add_surface_moments(const System& s, SecondOrderMemory& memory);

/// Then adds the forces of a tile's own particles to `f` and sets those on its rim, `rim_f`.
void add_forces(const System& s, Index tile, const SecondOrderMemory& memory, Double4* f, Double4* rim_f);

}  // namespace tessera
