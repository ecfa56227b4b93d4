#pragma once

#include "tessera/laws/lanes_response.hpp"
#include "tessera/laws/neo_hookean.hpp"

namespace tessera {

/// NeoHookean::response() of several deformations. Where J is not positive energy and stress have no meaning.
template <class Lanes>
inline LanesResponseOf<Lanes> response(const NeoHookean& law, const Lanes9Of<Lanes>& F) {
  const Lanes9Of<Lanes> cof = cofactor(F);
  const Lanes J = F.xx * cof.xx + F.xy * cof.xy + F.xz * cof.xz;
  const Lanes ln_J = log(J);
  const double mu = law.mu;
  const Lanes c = (law.lambda * ln_J - mu) / J;
  const auto stress = [&](const Lanes& cofactor, const Lanes& f) { return c * cofactor + mu * f; };
  return {ln_J * (0.5 * law.lambda * ln_J - mu) + 0.5 * mu * (contract(F, F) - 3.0),
          {stress(cof.xx, F.xx), stress(cof.xy, F.xy), stress(cof.xz, F.xz), stress(cof.yx, F.yx), stress(cof.yy, F.yy),
           stress(cof.yz, F.yz), stress(cof.zx, F.zx), stress(cof.zy, F.zy), stress(cof.zz, F.zz)},
          J};
}

}  // namespace tessera
