#pragma once

#include "tessera/mechanics/cell_sweeps.hpp"

namespace tessera {

/// Stresses at the points of all cells where laws see the mean change of volume around a cell: what fluctuates within a
/// cell is isochoric. With J_ak at the six points, the cell's own change of volume J_a, the mean of J_ak, and its mean
/// Jbar = S S J over the neighbours, the energy is
///
///     sum_a V_a (1/6) sum_k U(Fbar_ak),   Fbar_ak = (Jbar_a / J_ak)^(1/3) F_ak,
///
/// and with the mean Cauchy stresses p_ak of the law, p_a their mean, it changes by
///
///     P_ak = (Jbar_a / J_ak)^(1/3) Pbar_ak - p_ak (Jbar_a / J_ak) cof F_ak   at each point,   (S S p)_a   by J_a.
class AveragedCubature {
 public:
  explicit AveragedCubature(const System& s);

  /// `points` are the E_q of all cells; afterwards what multiplies them in the energy, V_a dU/dE_q [J]. No viscous
  /// part.
  StressSums evaluate(const Tensor* F, ThreeTensors* points, const HistorySpan& history, const CellReport& report);

  const Tensor* P() const { return P_.data(); }  // mean over each cell [Pa]
  /// F_a of cell a, with the mean change of volume that the law has seen there in the last evaluation.
  Mat3 law_deformation(std::size_t a, const Tensor& F) const;

 private:
  void volume_changes(const Tensor* F, const ThreeTensors* E);
  void add_pressures(const Tensor* F, ThreeTensors* points);

  const System& s_;
  std::vector<double> J_;
  std::vector<double> p_;  // mean over each cell of the mean Cauchy stresses that the law has given [Pa]
  std::vector<double> once_, mean_;
  Field<Tensor> P_;
  Field<ThreeTensors> moments_;  // V_a dU/dE_q without the mean of p [J]
};

}  // namespace tessera
