#pragma once

#include "tessera/base/vec3.hpp"

namespace tessera {

/// Energy and derivatives of one bond.
struct BondResponse {
  double energy = 0.0;  // [J]
  Vec3 dU_dx;           // [N], [D 57]
  Vec3 dU_dy;           // [N], [D 58]
};

/// Linearly elastic bond with normal and tangential stiffness, [D 56-58], [V 49]: x is the current branch vector, y =
/// F_ab X_ab its affine image, and normal means along x.
inline BondResponse bond_response(double Kn, double Kt, const Vec3& x, const Vec3& y) {
  const Vec3 u = x - y;
  const double p = dot(u, x) / norm2(x);
  const Vec3 u_n = p * x, u_t = u - u_n;
  const Vec3 elastic = Kn * u_n + Kt * u_t;
  return {0.5 * (Kn * norm2(u_n) + Kt * norm2(u_t)), elastic + ((Kn - Kt) * p) * u_t, -elastic};
}

}  // namespace tessera
