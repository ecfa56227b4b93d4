#pragma once

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

/// How much the particles tell of second derivatives in the direction in which they tell least: the variance of the
/// squares s^2 of their places along it that no linear function of s explains, over the square of the mean s^2 of the
/// first `near` of them. It is
/// small in two layers.
double depth(std::span<const Vec3> branches, std::size_t near, Extent extent);

/// Least squares over the branches: if they extend in a plane, the second derivatives in it; no fit where they do not
/// determine as many as their extent has.
FittedQuadratic fit_quadratic(std::span<const Vec3> branches, Extent extent);

/// One particle's share W in H_a, by its branch.
Symmetric3 share_of(const QuadraticFit& fit, const Vec3& branch);

}  // namespace tessera
