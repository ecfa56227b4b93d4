#pragma once

#include <array>
#include <limits>
#include <span>

#include "tessera/discretization/second_derivatives.hpp"

namespace tessera {

/// The fit of one particle and what it makes of positions with noise of unit size.
struct FittedQuadratic {
  QuadraticFit fit;
  double deviation = std::numeric_limits<double>::infinity();  // of H_a; infinite where there is no fit [1/m2]
};

/// How far branches X_ab extend.
enum class Extent { line, plane, space };
Extent extent(std::span<const Vec3> branches);

/// How much the particles tell of second derivatives in the direction n in which they tell least: the variance of the
/// squares of s = n X_ab that no linear function of s explains. n has the length that makes s a number of cells:
/// 12 n m n = 1 with the cell's second moment m per volume. Four layers have 1, three 2/9 and two none.
double depth(std::span<const Vec3> branches, const Symmetric3& second_moment, Extent extent);

/// Least squares over the branches: if they extend in a plane, the second derivatives in it; no fit where they do not
/// determine as many as their extent has.
FittedQuadratic fit_quadratic(std::span<const Vec3> branches, Extent extent);

/// One particle's share W in H_a, by its branch.
Symmetric3 share_of(const QuadraticFit& fit, const Vec3& branch);

/// One particle's share in M : H_a, by its branch: v chi' with v = 2 S_a M, since f is 2 where a component stands once
/// in M.
struct ContractedFit {
  double operator()(const Vec3& X) const {
    const std::array<double, 6>& v = of_products;
    return X.x * (v[0] * X.x + v[1] * X.y + v[2] * X.z) + X.y * (v[3] * X.y + v[4] * X.z) + v[5] * X.z * X.z -
           dot(of_branch, X);
  }
  std::array<double, 6> of_products{};
  Vec3 of_branch;
};

ContractedFit contracted(const QuadraticFit& fit, const Symmetric3& M);

}  // namespace tessera
