#pragma once

#include <array>

#include "tessera/base/mat3.hpp"

namespace tessera {

/// What a plastic solid remembers at one stress point; at first nothing has flowed.
struct PlasticState {
  std::array<double, 6> Cp_inverse{1, 1, 1, 0, 0, 0};  // F_p^-1 F_p^-T: xx, yy, zz, yz, zx, xy
  double strain = 0.0;                                 // equivalent plastic strain

  Mat3 tensor() const {
    const auto& c = Cp_inverse;
    return {{c[0], c[5], c[4], c[5], c[1], c[3], c[4], c[3], c[2]}};
  }
  /// From a symmetric tensor.
  static PlasticState of(const Mat3& Cp_inverse, double strain) {
    const Mat3& c = Cp_inverse;
    return {{c(0, 0), c(1, 1), c(2, 2), c(1, 2), c(2, 0), c(0, 1)}, strain};
  }

  friend bool operator==(const PlasticState&, const PlasticState&) = default;
};

}  // namespace tessera
