#pragma once

#include <array>

#include "tessera/base/lanes.hpp"
#include "tessera/base/mat3.hpp"
#include "tessera/laws/plastic_state.hpp"

namespace tessera {

/// What a law answers to several deformations at once.
template <class Lanes>
struct LanesResponseOf {
  Lanes energy;            // stored, per reference volume [J/m3]
  Lanes9Of<Lanes> stress;  // first Piola-Kirchhoff [Pa]
  Lanes J;                 // det F
  Lanes dissipated{};      // by plastic flow since the history `before`, per reference volume [J/m3]
};
using LanesResponse = LanesResponseOf<Double4>;

/// The histories of several stress points, of which laws without internal variables take no notice. Where `after` is
/// null nothing is kept.
template <class Lanes>
struct LanesHistoryOf {
  std::array<const PlasticState*, lanes_in<Lanes>> before{};
  std::array<PlasticState*, lanes_in<Lanes>> after{};
};
using LanesHistory = LanesHistoryOf<Double4>;

/// Tensor k of several.
template <class Lanes>
inline Mat3 tensor_of(const Lanes9Of<Lanes>& t, int k) {
  return {{t.xx[k], t.xy[k], t.xz[k], t.yx[k], t.yy[k], t.yz[k], t.zx[k], t.zy[k], t.zz[k]}};
}

template <class Lanes>
inline void set_tensor(Lanes9Of<Lanes>& t, int k, const Mat3& m) {
  t.xx[k] = m(0, 0), t.xy[k] = m(0, 1), t.xz[k] = m(0, 2);
  t.yx[k] = m(1, 0), t.yy[k] = m(1, 1), t.yz[k] = m(1, 2);
  t.zx[k] = m(2, 0), t.zy[k] = m(2, 1), t.zz[k] = m(2, 2);
}

/// The cofactor matrices, det(F) F^-T.
template <class Lanes>
inline Lanes9Of<Lanes> cofactor(const Lanes9Of<Lanes>& F) {
  return {F.yy * F.zz - F.yz * F.zy, F.yz * F.zx - F.yx * F.zz, F.yx * F.zy - F.yy * F.zx,
          F.xz * F.zy - F.xy * F.zz, F.xx * F.zz - F.xz * F.zx, F.xy * F.zx - F.xx * F.zy,
          F.xy * F.yz - F.xz * F.yy, F.xz * F.yx - F.xx * F.yz, F.xx * F.yy - F.xy * F.yx};
}

template <class Lanes>
inline Lanes contract(const Lanes9Of<Lanes>& a, const Lanes9Of<Lanes>& b) {
  return (a.xx * b.xx + a.xy * b.xy + a.xz * b.xz) + (a.yx * b.yx + a.yy * b.yy + a.yz * b.yz) +
         (a.zx * b.zx + a.zy * b.zy + a.zz * b.zz);
}

}  // namespace tessera
