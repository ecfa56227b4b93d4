#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/base/field.hpp"
#include "tessera/base/mat3.hpp"
#include "tessera/base/symmetric.hpp"

namespace tessera {

/// One particle's share in the position of a face, c_f = sum_k weight_k x_k.
struct FaceTerm {
  Index particle = 0;
  double weight = 0.0;
};

/// Second derivatives from first ones. F'_a is the linear-exact gradient that particles alone determine; of its
/// differences
///
///     G_a = sum_b (F'_b - F'_a) (x) C_ab        over the neighbours with a common face, C between centroids,
///     H_a = S_a : G_a ,
///
/// exact for quadratic motion, and of those the mean of a cell and its neighbours, H_a + ..., each with its own weight
///
///     mean H_a = sum_b q_b H_b / sum_b q_b .
///
/// S_a has one row for each second derivative (xx, xy, xz, yy, yz, zz, as in Symmetric3) and the columns 3 j + k of
/// d F_ij / d X_k.
struct SecondDerivatives {
  using Map = std::array<double, 54>;
  RawField<Map> map;                  // S_a [1/m2]; zero where quadratics are not resolved
  std::vector<char> resolved;         // 0 or 1
  std::vector<double> weight;         // q_a; zero where not resolved
  std::vector<double> amplification;  // what H_a makes of noise, in units of the distance to the neighbours
};

/// A boundary face with a node. F'_a of its owner follows the particles there too.
struct HeldFace {
  Index owner = 0;
  Vec3 area;  // outward [m2]
};

struct Discretization;
struct SecondOrder;

/// One particle's share in the mean H_a, W (x_b - x_a).
struct CurvatureTerm {
  Index particle = 0;
  Symmetric3 W;  // [1/m2]
};

/// What F'_a makes of second derivatives beside the mean over the cell: F'_a = mean + sum_j (m[j] : H) e_j, for each
/// component of the motion.
using MeanError = std::array<Symmetric3, 3>;

/// Fits all particles; `s` must have its held faces, `C` are the centroids of the cells. Cells that are `refused`, or
/// whose neighbours do not determine the second derivatives, are not resolved. A body in one plane has those in it.
SecondDerivatives second_derivatives(const Discretization& d, const SecondOrder& s, std::span<const Vec3> C,
                                     std::span<const MeanError> errors, std::span<const char> refused);

/// The mean H_a as a sum over particles, ascending, without a itself.
std::vector<CurvatureTerm> mean_curvature(const Discretization& d, const SecondOrder& s, std::span<const Vec3> C,
                                          Index a);

}  // namespace tessera
