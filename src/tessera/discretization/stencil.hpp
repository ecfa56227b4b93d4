#pragma once

#include <span>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// How well the weights of a stencil do their job.
struct StencilFit {
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
