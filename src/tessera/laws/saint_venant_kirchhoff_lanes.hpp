#pragma once

#include "tessera/laws/lanes_response.hpp"
#include "tessera/laws/saint_venant_kirchhoff.hpp"

namespace tessera {

/// SaintVenantKirchhoff::response() of several deformations.
template <class Lanes>
inline LanesResponseOf<Lanes> response(const SaintVenantKirchhoff& law, const Lanes9Of<Lanes>& F) {
  const Lanes9Of<Lanes> cof = cofactor(F);
  const auto product = [&](const Lanes& ax, const Lanes& bx, const Lanes& ay, const Lanes& by, const Lanes& az,
                           const Lanes& bz) { return ax * bx + ay * by + az * bz; };
  const Lanes E_xx = 0.5 * (product(F.xx, F.xx, F.yx, F.yx, F.zx, F.zx) - 1.0),
              E_yy = 0.5 * (product(F.xy, F.xy, F.yy, F.yy, F.zy, F.zy) - 1.0),
              E_zz = 0.5 * (product(F.xz, F.xz, F.yz, F.yz, F.zz, F.zz) - 1.0),
              E_yz = 0.5 * product(F.xy, F.xz, F.yy, F.yz, F.zy, F.zz),
              E_zx = 0.5 * product(F.xz, F.xx, F.yz, F.yx, F.zz, F.zx),
              E_xy = 0.5 * product(F.xx, F.xy, F.yx, F.yy, F.zx, F.zy);
  const Lanes tr = E_xx + E_yy + E_zz, pressure = law.lambda * tr;
  const double twice = 2.0 * law.mu;
  const Lanes S_xx = pressure + twice * E_xx, S_yy = pressure + twice * E_yy, S_zz = pressure + twice * E_zz,
              S_yz = twice * E_yz, S_zx = twice * E_zx, S_xy = twice * E_xy;
  const Lanes shear = E_yz * E_yz + E_zx * E_zx + E_xy * E_xy;
  return {0.5 * pressure * tr + law.mu * (E_xx * E_xx + E_yy * E_yy + E_zz * E_zz + 2.0 * shear),
          {product(F.xx, S_xx, F.xy, S_xy, F.xz, S_zx), product(F.xx, S_xy, F.xy, S_yy, F.xz, S_yz),
           product(F.xx, S_zx, F.xy, S_yz, F.xz, S_zz), product(F.yx, S_xx, F.yy, S_xy, F.yz, S_zx),
           product(F.yx, S_xy, F.yy, S_yy, F.yz, S_yz), product(F.yx, S_zx, F.yy, S_yz, F.yz, S_zz),
           product(F.zx, S_xx, F.zy, S_xy, F.zz, S_zx), product(F.zx, S_xy, F.zy, S_yy, F.zz, S_yz),
           product(F.zx, S_zx, F.zy, S_yz, F.zz, S_zz)},
          F.xx * cof.xx + F.xy * cof.xy + F.xz * cof.xz};
}

}  // namespace tessera
