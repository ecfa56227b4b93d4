#pragma once

#include <span>
#include <vector>

#include "tessera/base/mat3.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/generators.hpp"

namespace tessera {

/// Up to which degree the positions of faces are exact.
enum class FaceOrder { linear, quadratic };

/// Consistent face formulation (theory, "Consistent faces"): every face has one position c_f, exact for linear motion
/// and the same seen from both sides, V_a F_a = sum_f c_f (x) A_f. `D` holds one projection per boundary face, [V 14].
/// Quadratic faces need the second moments of faces; they are linear where quadratics are not resolved.
/// Throws GeometryError that names the particles whose neighbours cannot carry a linear motion.
Discretization discretize_consistent(const Generators& X, const Cells& cells, std::span<const Mat3> D,
                                     FaceOrder order = FaceOrder::linear);

/// What the forces of the ghost formulation derive from.
enum class GhostForce {
  variational,  // [V 43]: from the potential, and direct reactions at constrained faces; momenta exact, patch test C
                // not
  quasi_static  // [V 42] with tractions and reactions: patch tests exact, angular momentum not
};

/// Ghost formulation of [V]: F_a from [V 6, 26], ghosts from [V 15-24]. `D` holds one projection per boundary face.
/// Throws GeometryError that names a particle that lies (nearly) in the plane of one of its boundary faces.
Discretization discretize_ghosts(const Generators& X, const Cells& cells, std::span<const Mat3> D, GhostForce force);

}  // namespace tessera
