#pragma once

#include "tessera/laws/lanes_response.hpp"
#include "tessera/laws/mooney_rivlin.hpp"

namespace tessera {

/// MooneyRivlin::response() of several deformations. Where J is not positive energy and stress have no meaning.
template <class Lanes>
inline LanesResponseOf<Lanes> response(const MooneyRivlin& law, const Lanes9Of<Lanes>& F) {
  const Lanes9Of<Lanes> cof = cofactor(F);
  const Lanes J = F.xx * cof.xx + F.xy * cof.xy + F.xz * cof.xz;
  const Lanes ln_J = log(J), root = exp((-2.0 / 3.0) * ln_J);
  const Lanes I_1 = contract(F, F), I_2 = contract(cof, cof);
  const Lanes a = law.c10 * root, b = law.c01 * root * root;
  const double bulk = law.volumetric.bulk;
  const Lanes pressure = 0.5 * bulk * (J * J - 1.0) - (2.0 / 3.0) * a * I_1 - (4.0 / 3.0) * b * I_2;
  const Lanes on_F = 2.0 * (a + b * I_1), on_FC = -2.0 * b, on_cof = pressure / J;
  const Lanes C_xx = F.xx * F.xx + F.yx * F.yx + F.zx * F.zx, C_yy = F.xy * F.xy + F.yy * F.yy + F.zy * F.zy,
              C_zz = F.xz * F.xz + F.yz * F.yz + F.zz * F.zz, C_yz = F.xy * F.xz + F.yy * F.yz + F.zy * F.zz,
              C_zx = F.xz * F.xx + F.yz * F.yx + F.zz * F.zx, C_xy = F.xx * F.xy + F.yx * F.yy + F.zx * F.zy;
  const auto entry = [&](const Lanes& f, const Lanes& c, const Lanes& FC) {
    return on_F * f + on_cof * c + on_FC * FC;
  };
  const auto row_x = [&](const Lanes& x, const Lanes& y, const Lanes& z) { return x * C_xx + y * C_xy + z * C_zx; };
  const auto row_y = [&](const Lanes& x, const Lanes& y, const Lanes& z) { return x * C_xy + y * C_yy + z * C_yz; };
  const auto row_z = [&](const Lanes& x, const Lanes& y, const Lanes& z) { return x * C_zx + y * C_yz + z * C_zz; };
  return {a * I_1 - 3.0 * law.c10 + (b * I_2 - 3.0 * law.c01) + 0.25 * bulk * (J * J - 1.0 - 2.0 * ln_J),
          {entry(F.xx, cof.xx, row_x(F.xx, F.xy, F.xz)), entry(F.xy, cof.xy, row_y(F.xx, F.xy, F.xz)),
           entry(F.xz, cof.xz, row_z(F.xx, F.xy, F.xz)), entry(F.yx, cof.yx, row_x(F.yx, F.yy, F.yz)),
           entry(F.yy, cof.yy, row_y(F.yx, F.yy, F.yz)), entry(F.yz, cof.yz, row_z(F.yx, F.yy, F.yz)),
           entry(F.zx, cof.zx, row_x(F.zx, F.zy, F.zz)), entry(F.zy, cof.zy, row_y(F.zx, F.zy, F.zz)),
           entry(F.zz, cof.zz, row_z(F.zx, F.zy, F.zz))},
          J};
}

}  // namespace tessera
