#pragma once

#include "tessera/mechanics/sweeps.hpp"

namespace tessera {

/// Elastic stress where laws see the mean change of volume around a particle: the energy is
///
///     sum_a V_a U(Fbar_a),   Fbar_a = (Jbar_a / J_a)^(1/3) F_a,
///
/// and P_a its derivative by F_a over V_a: with the mean Cauchy stress p_a of the law at Fbar_a
///
///     P_a = (Jbar_a / J_a)^(1/3) Pbar_a + (mean of p - p_a Jbar_a / J_a) J_a F_a^-T.
///
/// Linear motions have Jbar = J, so patch tests know nothing of it.
class AveragedStress {
 public:
  explicit AveragedStress(const System& s);

  /// P of every particle from F; sums of energies, of what has flowed, and the smallest J. No viscous part.
  StressSums evaluate(const Tensor* F, const HistorySpan& history);

  const Tensor* P() const { return P_.data(); }  // [Pa]
  /// Fbar_a, the deformation that the law has seen at particle a in the last evaluation.
  Mat3 law_deformation(std::size_t a, const Tensor& F) const;

 private:
  const System& s_;
  std::vector<double> J_, Jbar_;  // of particles, and its mean over the neighbours
  std::vector<double> p_, pbar_;  // P(Fbar_a) : Fbar_a / (3 Jbar_a), the mean Cauchy stress that the law has given
                                  // [Pa], and its mean
  std::vector<double> once_;
  Field<Tensor> P_;
};

}  // namespace tessera
