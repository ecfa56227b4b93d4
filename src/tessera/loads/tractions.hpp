#pragma once

#include <span>
#include <vector>

#include "tessera/discretization/discretization.hpp"
#include "tessera/loads/assignment.hpp"
#include "tessera/loads/nodal_force.hpp"

namespace tessera {

/// A load entry at one site of the discretization; `free` = I - D takes out what a constraint holds.
struct LoadedSite {
  Index site = 0;
  Mat3 free;
  const BoundaryCondition* condition = nullptr;
};

/// Loads on faces as forces on particles: A T_f through the sites' load shares, the gradient of - sum_f A_f T_f . c_f
/// (consistent), [V 35] (ghosts), or shared by the vertices of a triangle (delaunay).
class Tractions {
 public:
  Tractions(const Discretization& d, std::vector<LoadedSite> sites);
  Tractions() = default;

  /// Evaluates the forces at time t, pressures that follow left out. Only particles that ever carry a load are listed,
  /// each once, ascending.
  void evaluate(double t);
  std::span<const NodalForce> forces() const { return forces_; }

  /// The sites whose pressure follows the face; one may occur several times.
  std::span<const Index> following_sites() const { return following_sites_; }
  /// Adds the pressures that follow, at the time of evaluate(). `normals` are the present area vectors of
  /// following_sites() per reference area, J F^-T N. Calling it again replaces what it added.
  void follow(std::span<const Vec3> normals);

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
  void add(const Loaded& site, const Vec3& traction);

  std::vector<Loaded> sites_, following_;
  std::vector<Index> following_sites_;
  std::vector<double> pressures_;  // of following_ [Pa]
  std::vector<NodalForce> dead_;   // without them; empty when nothing follows
  std::vector<NodalForce> forces_;
};

}  // namespace tessera
