#pragma once

#include <Eigen/Dense>
#include <vector>

#include "tessera/dynamics/vectors.hpp"

namespace tessera {

/// Largest eigenvalue of an operator as far as a Krylov space knows it.
struct Ritz {
  double value = 0.0;     // its size
  double residual = 0.0;  // of the Ritz vector: an eigenvalue lies within this distance
  double next = 0.0;      // length of what the next direction adds
  Eigen::VectorXd coefficients;
};

/// Orthonormal basis of the space that repeated application of an operator spans, by Lanczos' three-term recurrence
/// for symmetric operators, else by Arnoldi's. Vectors are kept in single precision, for orthogonalisation and for the
/// Ritz vector only: 12 bytes a particle and iteration.
class KrylovSpace {
 public:
  enum class Kind { symmetric, general };

  KrylovSpace(Kind kind, Vectors start);

  /// The direction that the operator is to be applied to next, of length one.
  const Vectors& direction() const { return q_; }
  /// Takes what the operator made of it (and uses the memory of `w`). False when there is no further direction.
  bool extend(Vectors& w);

  Ritz largest() const;
  /// The Ritz vector, of length one.
  Vectors vector(const Ritz& ritz) const;

 private:
  struct Single {
    float x, y, z;
  };
  using Basis = std::vector<Field<Single>>;

  void keep_direction();
  std::vector<double> orthogonalise(Vectors& w) const;
  std::vector<double> recur(Vectors& w) const;

  Kind kind_;
  Vectors q_, previous_;
  Basis basis_;
  std::vector<std::vector<double>> columns_;  // of the projected operator, each with one entry below the diagonal
};

}  // namespace tessera
