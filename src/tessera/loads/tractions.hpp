#pragma once

#include <span>
#include <vector>

#include "tessera/discretization/discretization.hpp"
#include "tessera/loads/assignment.hpp"
#include "tessera/loads/nodal_force.hpp"

namespace tessera {

/// A traction entry at one site of the discretization; `free` = I - D takes out what a constraint holds.
struct LoadedSite {
  Index site = 0;
  Mat3 free;
  const BoundaryCondition* condition = nullptr;
};

/// Nominal tractions and pressures as forces on particles: A T_f through the sites' load shares, the gradient of
/// - sum_f A_f T_f . c_f (consistent), [V 35] (ghosts), or shared by the vertices of a triangle (delaunay).
class Tractions {
 public:
  Tractions(const Discretization& d, std::vector<LoadedSite> sites);
  Tractions() = default;

  /// Evaluates the forces at time t. Only particles that ever carry a load are listed, each once, ascending.
  void evaluate(double t);
  std::span<const NodalForce> forces() const { return forces_; }

 private:
  struct Share {
    std::size_t force;  // index into forces_
    double area;
  };
  struct Loaded {
    Vec3 X, N;
    Mat3 free;
    const BoundaryCondition* condition;
    std::vector<Share> shares;
  };
  std::vector<Loaded> sites_;
  std::vector<NodalForce> forces_;
};

}  // namespace tessera
