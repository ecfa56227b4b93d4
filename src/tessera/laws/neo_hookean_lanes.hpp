#pragma once

#include "tessera/base/lanes.hpp"
#include "tessera/laws/neo_hookean.hpp"

namespace tessera {

/// What a law answers to four deformations at once.
struct LanesResponse {
  Double4 energy;  // [J/m3]
  Lanes9 stress;   // first Piola-Kirchhoff [Pa]
  Double4 J;       // det F
};

/// NeoHookean::response() of four deformations. Where J is not positive energy and stress have no meaning.
inline LanesResponse response(const NeoHookean& law, const Lanes9& F) {
  const Lanes9 cof{F.yy * F.zz - F.yz * F.zy, F.yz * F.zx - F.yx * F.zz, F.yx * F.zy - F.yy * F.zx,
                   F.xz * F.zy - F.xy * F.zz, F.xx * F.zz - F.xz * F.zx, F.xy * F.zx - F.xx * F.zy,
                   F.xy * F.yz - F.xz * F.yy, F.xz * F.yx - F.xx * F.yz, F.xx * F.yy - F.xy * F.yx};
  const Double4 J = F.xx * cof.xx + F.xy * cof.xy + F.xz * cof.xz;
  const Double4 ln_J = log(J);
  const Double4 FF = (F.xx * F.xx + F.xy * F.xy + F.xz * F.xz) + (F.yx * F.yx + F.yy * F.yy + F.yz * F.yz) +
                     (F.zx * F.zx + F.zy * F.zy + F.zz * F.zz);
  const double mu = law.mu;
  const Double4 c = (law.lambda * ln_J - mu) / J;
  const auto stress = [&](const Double4& cofactor, const Double4& f) { return c * cofactor + mu * f; };
  return {ln_J * (0.5 * law.lambda * ln_J - mu) + 0.5 * mu * (FF - 3.0),
          {stress(cof.xx, F.xx), stress(cof.xy, F.xy), stress(cof.xz, F.xz), stress(cof.yx, F.yx), stress(cof.yy, F.yy),
           stress(cof.yz, F.yz), stress(cof.zx, F.zx), stress(cof.zy, F.zy), stress(cof.zz, F.zz)},
          J};
}

}  // namespace tessera
