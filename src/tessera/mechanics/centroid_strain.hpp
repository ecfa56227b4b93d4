#pragma once

#include "tessera/base/field.hpp"
#include "tessera/mechanics/system.hpp"

namespace tessera {

/// F at the centroids of cells where some F_a belong elsewhere (theory, section 11), F_a + sum_b w_ab (F_b - F_a), and
/// the way back: what stresses at the points of cells do to the F_a.
class CentroidStrain {
 public:
  explicit CentroidStrain(const System& s) : s_(s), F_(s.d.X.size()), P_(s.d.X.size()) {}

  /// F at the centroids of all cells.
  const Tensor* find(const Tensor* F);
  /// Where the mean stresses of cells may be kept.
  Tensor* stresses() { return P_.data(); }
  /// Adds to the T_b of all cells what the mean stresses P_a of moved ones do to F_b, sum_a (V_a / V_b) w_ab P_a.
  void give_back(const Tensor* P, Tensor* T) const;

 private:
  const System& s_;
  Field<Tensor> F_, P_;
};

}  // namespace tessera
