#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "tessera/base/mat3.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// Neighbour of a boundary particle in the ghost formulation: real, or the mirror image in a boundary plane.
struct GhostNeighbour {
  Vec3 X_ab;  // branch vector [m]
  Vec3 B_ab;  // gradient vector, [V 7] [m2]
};

/// H_acd = X_ac . B_ad / V_a, [V 16], over all neighbours (real ones first, then ghosts).
Eigen::MatrixXd branch_expansion(std::span<const GhostNeighbour> neighbours, double V_a);

/// K_abc of the least squares for the ghosts, [V 18].
Eigen::MatrixXd least_squares_matrix(const Eigen::MatrixXd& H);

/// The coefficients K'_abc, [V 22]: x'_ab = sum_c K'_abc x_ac for the ghosts b in `free`, over the neighbours c not in
/// `free`. Rows as in `free`; the columns of ghosts in `free` are zero. Directions that the sum of squares does not
/// determine (out of a plane of particles) are left out (pseudo-inverse).
Eigen::MatrixXd ghost_coefficients(const Eigen::MatrixXd& K, std::span<const int> free);

}  // namespace tessera
