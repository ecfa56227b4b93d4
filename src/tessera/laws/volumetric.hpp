#pragma once

#include <cmath>

namespace tessera {

/// Energy of a change of volume, K/4 (J^2 - 1 - 2 ln J): grows without bound for J -> 0 and for J -> infinity, and is
/// convex (Simo and Taylor, Computer Methods in Applied Mechanics and Engineering 85 (1991) 273-310).
struct VolumetricEnergy {
  double bulk = 0.0;  // K [Pa]

  double energy(double J) const { return 0.25 * bulk * (J * J - 1.0 - 2.0 * std::log(J)); }
  /// Its derivative by ln J, the mean Kirchhoff stress [Pa].
  double stress(double J) const { return 0.5 * bulk * (J * J - 1.0); }
  /// The second derivative by ln J [Pa].
  double stiffness(double J) const { return bulk * J * J; }
};

}  // namespace tessera
