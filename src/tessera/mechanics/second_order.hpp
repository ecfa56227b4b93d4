#pragma once

#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/discretization/cell_measure.hpp"
#include "tessera/mechanics/hessians.hpp"

namespace tessera {

/// What does not change of second-order integration.
struct SecondOrderSystem {
  /// How much of F_b - F_a a cell's three points see, or of their stresses a neighbour.
  struct GradientTerm {
    Index cell = 0;  // b in `gradients`, number of the unresolved cell in `returned`
    Vec3 weight;
  };

  HessianRows rows;
  std::vector<Mat3> points;       // columns: distances of three cubature points from the centroid [m]
  std::vector<Index> unresolved;  // cells whose points follow from the neighbours' F, ascending
  Csr<GradientTerm> gradients;    // one row for each of them
  std::vector<Index> receivers;   // cells that these rows name, ascending, with one row each
  Csr<GradientTerm> returned;
};

/// Needs the bonds.
SecondOrderSystem second_order_system(const Discretization& d);

/// What changes with every evaluation.
struct SecondOrderMemory {
  Field<Hessian> H;            // H_a; later G_a, the derivative of the energy with respect to it
  Field<ThreeTensors> points;  // F at three points of each cell less F_a; later what multiplies it in the energy [J]
  Field<FitMoment> moments;
  Field<Tensor> T;  // complete stresses [Pa]

  explicit SecondOrderMemory(std::size_t particles)
      : H(particles), points(particles), moments(particles), T(particles) {}
};

/// Second derivatives of all particles.
void find_hessians(const SecondOrderSystem& s, const Double4* x, SecondOrderMemory& memory);

/// Adds to F what second derivatives do by the positions of faces.
void add_curvature_strain(const SecondOrderSystem& s, const double* volume, const SecondOrderMemory& memory, Tensor* F);

/// When F is complete: `points` of the cells [begin, end), from H_a, or from differences of F where it is not resolved.
void find_point_strains(const SecondOrderSystem& s, Index begin, Index end, const Tensor* F, SecondOrderMemory& memory);

/// When the stresses at the points of the cells [begin, end) are known: what they do by the second derivatives.
void take_moments(const SecondOrderSystem& s, Index begin, Index end, SecondOrderMemory& memory);

/// When all those are: adds to T what unresolved cells do to their neighbours.
void return_gradients(const SecondOrderSystem& s, const double* volume, SecondOrderMemory& memory);

/// When T is complete: the forces of moments and stresses by way of the second derivatives.
void add_hessian_forces(const SecondOrderSystem& s, SecondOrderMemory& memory, Double4* f);

}  // namespace tessera
