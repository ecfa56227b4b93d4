#pragma once

#include <vector>

#include "tessera/mechanics/forces.hpp"

namespace tessera {

/// How much stiffer a body has become since a state that is remembered: the largest growth, over the particles, of the
/// modulus of plane waves about the local deformation. Frequencies grow by its square root. It needs no evaluation of
/// the forces, only their deformation gradients.
class Stiffening {
 public:
  /// Remembers nothing yet.
  explicit Stiffening(const System& system) : system_(system), moduli_(system.mass.size()) {}

  void remember(const Forces& forces);
  /// Largest ratio of the moduli about the forces' deformation to those remembered.
  double growth(const Forces& forces) const;

  /// The moduli remembered [Pa], which a resumed run must put back.
  const std::vector<double>& moduli() const { return moduli_; }
  void restore(std::vector<double> moduli) { moduli_ = std::move(moduli); }

 private:
  const System& system_;
  std::vector<double> moduli_;
};

}  // namespace tessera
