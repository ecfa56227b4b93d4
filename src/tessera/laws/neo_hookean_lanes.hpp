#pragma once

#include "tessera/laws/lanes_response.hpp"
#include "tessera/laws/neo_hookean.hpp"

namespace tessera {

/// NeoHookean::response() of four deformations. Where J is not positive energy and stress have no meaning.
inline LanesResponse response(const NeoHookean& law, const Lanes9& F) {
  const Lanes9 cof = cofactor(F);
  const Double4 J = F.xx * cof.xx + F.xy * cof.xy + F.xz * cof.xz;
  const Double4 ln_J = log(J);
  const double mu = law.mu;
  const Double4 c = (law.lambda * ln_J - mu) / J;
  const auto stress = [&](const Double4& cofactor, const Double4& f) { return c * cofactor + mu * f; };
  return {ln_J * (0.5 * law.lambda * ln_J - mu) + 0.5 * mu * (contract(F, F) - 3.0),
          {stress(cof.xx, F.xx), stress(cof.xy, F.xy), stress(cof.xz, F.xz), stress(cof.yx, F.yx), stress(cof.yy, F.yy),
           stress(cof.yz, F.yz), stress(cof.zx, F.zx), stress(cof.zy, F.zy), stress(cof.zz, F.zz)},
          J};
}

}  // namespace tessera
