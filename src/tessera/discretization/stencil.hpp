#pragma once

#include <span>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// The weights of a stencil as a function of the position relative to its reference point, y [m]:
/// w(y) = (constant + gradient . y) / |y|^2. It takes less memory than the weights.
struct StencilFunction {
  double constant = 0.0;  // [m2]
  Vec3 gradient;          // [m]

  double operator()(const Vec3& y) const { return (constant + dot(gradient, y)) / norm2(y); }
  bool is_zero() const { return constant == 0.0 && gradient == Vec3{}; }
};

/// The weights of a stencil and how well they do their job.
struct StencilFit {
  StencilFunction function;    // w_c is its value at y_c, bit by bit
  Vec3 residual;               // target - sum w_c y_c [m]
  double amplification = 0.0;  // sqrt(sum w_c^2 r_c^2) / |target|: about one on a sound stencil
};

/// The weights with the least sum of |w_c|^2 r_c^2, r_c = |y_c|, that satisfy sum w_c = 0 and sum w_c y_c = target,
/// into `w` (one for each point). `y` are positions relative to the reference point [m], none of them zero. Directions
/// in which the points do not extend are left to the residual.
StencilFit balanced_weights(std::span<const Vec3> y, const Vec3& target, std::span<double> w);

/// The same without the condition sum w_c = 0.
StencilFit spanning_weights(std::span<const Vec3> y, const Vec3& target, std::span<double> w);

}  // namespace tessera
