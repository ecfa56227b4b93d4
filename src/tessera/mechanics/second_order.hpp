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

  /// How much of an extrapolated face's position a particle has, or of the force there.
  struct FaceShare {
    Index face = 0;
    double weight = 0.0;
  };

  CurvatureRows rows;
  std::vector<CurvedSurface> surfaces;  // of cells at free boundaries
  std::vector<Symmetric3> points;       // columns: distances of three cubature points from the centroid [m]
  std::vector<Index> unresolved;        // cells whose points follow from the neighbours' F, ascending
  Csr<GradientTerm> gradients;          // one row for each of them
  std::vector<Index> receivers;         // cells that these rows name, ascending, with one row each
  Csr<GradientTerm> returned;

  std::vector<HeldFace> held;        // faces of boundary nodes, in their order...
  Csr<FaceTerm> extrapolated;        // ... and where particles alone see them
  std::vector<Index> extrapolating;  // the particles in those rows, ascending, with one row each
  Csr<FaceShare> face_shares;
};

/// Needs the bonds.
SecondOrderSystem second_order_system(const Discretization& d, const Tiles& tiles);

/// What changes with every evaluation.
struct SecondOrderMemory {
  explicit SecondOrderMemory(const System& s);

  Field<Hessian> weighted;         // q_a H_a; later the derivative of the energy with respect to sum_b q_b H_b around a
  Field<Hessian> H;                // mean second derivatives
  Field<ThreeTensors> unresolved;  // F at three points of each unresolved cell less F_a; later what multiplies it [J]
  Field<ThreeTensors> points;      // the same of all cells where laws see a mean change of volume, else empty
  Field<Tensor> T;                 // complete stresses [Pa]
  Field<Tensor> T_first;           // stresses by way of F', but for rim_energies [Pa]
  RawField<Tensor> rim_energies;
  mutable parallel::Workspaces<CurvatureScratch> scratch;
};

/// When the strain sweep has left in F what bonds between particles do: F' first, second derivatives from it, and F but
/// for what boundary nodes do beyond the particles that see their faces too.
void add_curvature_strain(const System& s, const Double4* x, SecondOrderMemory& memory, Tensor* F);

/// When F is complete: `unresolved`, from differences of F.
void find_unresolved_strains(const SecondOrderSystem& s, const Tensor* F, SecondOrderMemory& memory);

/// Then `points` of all cells, from H_a where it is resolved.
void find_point_strains(const SecondOrderSystem& s, SecondOrderMemory& memory);

/// When `points` has become what multiplies them in the energy: what that does by the second derivatives.
void take_point_moments(const SecondOrderSystem& s, SecondOrderMemory& memory);

/// When all those are: adds to T what unresolved cells do to their neighbours.
void return_gradients(const SecondOrderSystem& s, const double* volume, SecondOrderMemory& memory);

/// When T is complete: the stresses T' that second derivatives make of it, those by way of F'.
void return_curvature(const System& s, SecondOrderMemory& memory);

/// T' of a tile's own particles, complete.
void recall_first(const System& s, Index tile, SecondOrderMemory& memory, Columns* T);

/// Adds the forces of T' - T by the extrapolated positions of faces. Complete T' must be in T_first for their owners.
void add_extrapolated_forces(const SecondOrderSystem& s, const SecondOrderMemory& memory, Double4* f);

}  // namespace tessera
