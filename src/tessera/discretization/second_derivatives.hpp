#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/base/field.hpp"
#include "tessera/base/symmetric.hpp"

namespace tessera {

struct Discretization;
struct MeanTerm;

/// The second derivatives of the quadratic motion that fits the positions of a particle's neighbours best. With
/// u_b = x_b - x_a and X X the six products of the components of X_ab, unweighted least squares give
///
///     H_a = f S_a sum_b (X X - A_a X_ab) (x) u_b ,
///
/// exact for quadratic motion; f is 2 for xx, yy, zz and 1 for xy, xz, yz, and S_a is symmetric.
struct QuadraticFit {
  std::array<double, 21> S{};  // rows xx, xy, xz, yy, yz, zz from the diagonal on [1/m4]
  std::array<double, 18> A{};  // one row of three for each of the six [m]
};

/// H_a of all particles, each with its own weight. Cells at the boundary, whose fits are one-sided, and those whose few
/// neighbours are not enough, use the mean of their own and their neighbours' in place of H_a,
///
///     mean H_a = sum_b q_b H_b / sum_b q_b .
struct SecondDerivatives {
  RawField<QuadraticFit> fit;         // zero where quadratics are not resolved
  Csr<Index> far;                     // what a fit takes beyond the neighbours with a common face, ascending
  std::vector<char> resolved;         // 0 or 1
  std::vector<char> averaged;         // 1 where the cell uses the mean
  std::vector<double> weight;         // q_a; zero where not resolved
  std::vector<double> amplification;  // what H_a makes of noise, in units of the distance to the neighbours
};

/// One particle's share in second derivatives at a, W (x_b - x_a).
struct CurvatureTerm {
  Index particle = 0;
  Symmetric3 W;  // [1/m2]
};

/// Where a cell is: a boundary face is its own, or a neighbour's.
enum class CellPlace : char { inside, near_boundary, at_boundary, refused };

/// Fits all particles of `d`, which must have its bonds and the measure of its cells. Cells that are refused, whose
/// neighbours and those of them do not determine the second derivatives, or that are not deep enough, are not resolved.
/// A body in one plane has those in it.
SecondDerivatives second_derivatives(const Discretization& d, std::span<const CellPlace> places);

/// H_a as a sum over particles, without a itself.
std::vector<CurvatureTerm> curvature(const Discretization& d, const SecondDerivatives& s, Index a);

/// The second derivatives that the cell uses, H_a or the mean, as a sum over particles, ascending, without a itself.
std::vector<CurvatureTerm> cell_curvature(const Discretization& d, const SecondDerivatives& s, Index a);

/// M : H of those, the sum of weight (x_b - x_a).
std::vector<MeanTerm> contracted_curvature(const Discretization& d, const SecondDerivatives& s, Index a,
                                           const Symmetric3& M);

}  // namespace tessera
