#pragma once

#include <vector>

#include "tessera/mechanics/forces.hpp"

namespace tessera {

/// How much stiffer a body has become since a state that is remembered: the largest growth, over the particles, of the
/// modulus of plane waves about the local deformation. Frequencies grow by its square root. It needs no evaluation of
/// the forces, only their deformation gradients.
///
/// Of cells with several stress points the mean deformation says too little where one of them is nearly flat. The
/// growth is then at least the mean over six points, one of which has the smallest J of all and is squeezed in one
/// direction, while the others have grown as the means.
class Stiffening {
 public:
  /// Remembers nothing yet.
  explicit Stiffening(const System& system) : system_(system), moduli_(system.mass.size()) {}

  void remember(const Forces& forces);
  /// Largest ratio of the moduli about the forces' deformation to those remembered.
  double growth(const Forces& forces) const;

  /// The moduli remembered [Pa], which a resumed run must put back.
  const std::vector<double>& moduli() const { return moduli_; }
  /// The smallest J of the stress points in the state remembered.
  double smallest_J() const { return smallest_J_; }
  void restore(std::vector<double> moduli, double smallest_J) {
    moduli_ = std::move(moduli);
    smallest_J_ = smallest_J;
  }

 private:
  double growth_of_means(const Forces& forces) const;
  double growth_when_squeezed(double J) const;

  const System& system_;
  std::vector<double> moduli_;
  double smallest_J_ = 1.0;
};

}  // namespace tessera
