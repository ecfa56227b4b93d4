#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/base/field.hpp"
#include "tessera/base/symmetric.hpp"

namespace tessera {

struct FaceOfCell;

/// Second derivatives at a particle from the positions around it,
///
///     H_a = sum_b W_ab (x_b - x_a) ,   W_ab = S_a (y, y (x) y) / |y|^2 ,   y = X_ab
///
/// by least squares of a quadratic polynomial through x_a with weights 1/|y|^2. S_a has one row for each second
/// derivative (xx, xy, xz, yy, yz, zz, as in Symmetric3) and a column for each component of y and of its products.
struct QuadraticFit {
  std::array<std::array<double, 9>, 6> S{};

  /// W_ab of a particle at `y` from this one [1/m2].
  Symmetric3 weights(const Vec3& y) const;
};

/// The fits of all particles.
struct QuadraticFits {
  Csr<Index> stencil;                 // the particles of each fit, ascending, without its own
  RawField<QuadraticFit> fit;         // zero where quadratics are not resolved
  std::vector<char> resolved;         // 0 or 1
  std::vector<double> amplification;  // V_a^(2/3) times the length of all weights: what a stencil makes of noise
};

/// Stencils as small as gives sound weights: inside a body the 26 nearest particles, more where they lie to one side.
/// A fit whose particles lie in one plane has the second derivatives in that plane only. Where even the widest stencil
/// does not determine the quadratics (two layers of particles), the fit is not resolved.
QuadraticFits quadratic_fits(std::span<const Vec3> X, std::span<const double> volume, const Csr<FaceOfCell>& faces);

}  // namespace tessera
