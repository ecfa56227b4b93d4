#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/base/field.hpp"
#include "tessera/base/index.hpp"
#include "tessera/base/mat3.hpp"
#include "tessera/base/symmetric.hpp"
#include "tessera/discretization/second_derivatives.hpp"

namespace tessera {

/// Directed bonds a -> b in compressed rows: row a lists the neighbours b in ascending order. The pattern is
/// symmetric: a is in row b whenever b is in row a.
struct Bonds {
  std::vector<Offset> offset{0};
  RawField<Index> neighbour;
  RawField<Vec3> B_ab;                // gradient vector: dF_a / dx_b = B_ab / V_a [m2]
  RawField<double> area_over_length;  // A_ab / L_ab of the bond stiffness [D 60], [V 50]; 0: no common face [m]

  Index rows() const { return static_cast<Index>(offset.size()) - 1; }
  Offset begin(Index a) const { return offset[static_cast<std::size_t>(a)]; }
  Offset end(Index a) const { return offset[static_cast<std::size_t>(a) + 1]; }
  Offset size() const { return static_cast<Offset>(neighbour.size()); }
  /// Position of the bond a -> b, or -1.
  Offset find(Index a, Index b) const;
  /// The neighbour's gradient vector towards a, for the bond at position `bond` in row a [m2].
  const Vec3& B_ba(Index a, Offset bond) const {
    return B_ab[static_cast<std::size_t>(find(neighbour[static_cast<std::size_t>(bond)], a))];
  }
};

/// Four points X +- first, X +- second, whose mean is that over a face with centroid X: for the principal axes of its
/// second moment of quadratic functions too. Zero: the centroid alone [m].
struct FaceSpread {
  Vec3 first, second;

  bool is_zero() const { return first == Vec3{} && second == Vec3{}; }
  /// The mean of f(point) about X.
  template <class Function>
  Vec3 mean(const Vec3& X, Function&& f) const {
    if (is_zero()) return f(X);
    return 0.25 * (f(X + first) + f(X - first) + f(X + second) + f(X - second));
  }
};

/// A point on the boundary whose motion is prescribed, wholly or in part: the position c_f of a constrained face
/// (consistent) or the ghost of its cell (variational, quasi-static).
///
///     x_f = wall_share D W_f(t) + sum_k (constrained_k D + free_k (I - D)) x_k        k: closure row
struct BoundaryNode {
  Index owner = 0;
  Index site = 0;           // the boundary face, index into Discretization::sites
  Vec3 X;                   // reference position of the node [m]
  Vec3 wall;                // reference position W_f of the prescribed point [m]
  FaceSpread spread;        // of the face over which prescribed motion is averaged
  Vec3 N;                   // outward unit normal of the face
  Vec3 area;                // outward area vector of the face [m2]
  Mat3 D;                   // projection onto the constrained directions, [V 14]
  double wall_share = 1.0;  // 1: node on the wall; 2: ghost behind it
  Vec3 B_af;                // the owner's gradient vector towards the node [m2]
  double area_over_length;  // of the boundary bond's stiffness [m]
};

/// One term of a boundary node's closure; `node` below the number of particles is a particle, else a boundary node.
struct ClosureTerm {
  Index node = 0;
  double constrained = 0.0;  // factor of D x_k
  double free = 0.0;         // factor of (I - D) x_k
};

/// A place on the boundary where a traction may act: a Voronoi face, or one vertex of a boundary triangle.
struct BoundarySite {
  Vec3 X;         // where the traction is evaluated [m]
  Vec3 N;         // outward unit normal
  Vec3 centroid;  // of the face or triangle, where selections are evaluated [m]
  Index side = -1;
  Index owner = 0;                           // Voronoi: particle whose cell this is; Delaunay: the vertex
  std::array<Index, 3> corners{-1, -1, -1};  // Delaunay: the triangle, counter-clockwise seen from outside
};

/// Area [m2] through which a site's traction acts on a particle.
struct LoadShare {
  Index particle = 0;
  double area = 0.0;
};

/// A particle with prescribed motion (delaunay): x_a = D x_bar(t) + (I - D) x_a.
struct ParticleConstraint {
  Index particle = 0;
  Mat3 D;
};

/// What a constrained boundary face exerts on its particle.
enum class BoundaryForce {
  potential,  // the derivative of the strain energy with respect to the particle's position
  direct      // [V 42, 43]: prescribed branch vectors count as constants, and D P_a A_af is added as a reaction
};

/// Rows of the internal force when it is not the gradient of an energy ([V 42], quasi-static).
struct DirectForce {
  std::vector<Vec3> B_ba;  // per bond [m2]
  std::vector<Vec3> B_aa;  // per particle [m2]
};

/// Of a cell at the boundary: sum_f A_f M_f over its free boundary faces, whose c_f += (mean H_a) : M_f; one vector for
/// each second derivative (xx, xy, xz, yy, yz, zz), mixed ones counted twice [m4].
struct CurvedSurface {
  Index particle = 0;
  std::array<Vec3, 6> area_moment;
};

/// What makes quadratic motion exact (theory, "Second order"): second derivatives, and the faces that they move, c_f +=
/// (q_a H_a + q_b H_b) / (q_a + q_b) : M_f. What they do to boundary nodes and load shares is part of these.
struct SecondOrder {
  SecondDerivatives derivatives;
  RawField<Symmetric3> M;               // per face between cells [m2]
  RawField<Index> face;                 // per bond, in M; -1 without a face, or if one of the cells is not resolved
  std::vector<CurvedSurface> surfaces;  // sorted by particle

  /// Of the bond's face; zero where second derivatives do not move it.
  Symmetric3 M_of_bond(Offset bond) const {
    const Index f = face[static_cast<std::size_t>(bond)];
    return f < 0 ? Symmetric3{} : M[static_cast<std::size_t>(f)];
  }
};

/// The part that F of a particle, or its stress, has in a sum.
struct MeanTerm {
  Index particle = 0;
  double weight = 0.0;
};

/// Cells whose F_a is not F at their centroid, which is F_a + sum_b weight (F_b - F_a).
struct MovedMeans {
  std::vector<Index> particles;  // ascending
  Csr<MeanTerm> terms;           // one row for each
};

/// The regions over which the F_a are means, for integrals over cells. Each has the particle's volume V_a.
struct CellMeasure {
  std::vector<Vec3> centroid;             // [m]
  std::vector<Symmetric3> second_moment;  // about the centroid, per volume; for the set-up only [m2]
  MovedMeans moved{};                     // none but at free faces of ghosts
};

/// What every formulation becomes: particles, bonds, boundary nodes with their closure, and load shares.
///
///     F_a = (1/V_a) [ sum_b x_ab (x) B_ab + sum_f (x_f - x_a) (x) B_af ]
///     f_a = - T_a B_aa - sum_b T_b B_ba   (+ what the boundary nodes hand back through the closure)
struct Discretization {
  std::vector<Vec3> X;         // reference positions of the particles [m]
  std::vector<double> volume;  // [m3]
  Bonds bonds;
  std::vector<Vec3> B_aa;           // - sum_b B_ab - sum_f B_af [m2]
  std::vector<BoundaryNode> nodes;  // sorted by owner; within one, fully prescribed nodes first
  Csr<ClosureTerm> closure;         // one row per boundary node
  BoundaryForce boundary_force = BoundaryForce::potential;
  std::optional<DirectForce> direct;  // set for quasi-static only
  std::vector<BoundarySite> sites;
  Csr<LoadShare> load;                          // one row per site
  std::vector<ParticleConstraint> constraints;  // sorted by particle
  std::optional<CellMeasure> measure;           // set where cells are integrated by cubature
  std::optional<SecondOrder> second_order;      // set for second-order integration only
  double body_volume = 0.0;                     // of the solid, for the identity sum V_a = V [m3]

  Index particles() const { return static_cast<Index>(X.size()); }
  /// Calls body(bond, b) for the bonds of a that have a face.
  template <class Body>
  void for_each_face_neighbour(Index a, Body&& body) const {
    for (Offset bond = bonds.begin(a); bond < bonds.end(a); ++bond)
      if (bonds.area_over_length[static_cast<std::size_t>(bond)] > 0.0)
        body(bond, bonds.neighbour[static_cast<std::size_t>(bond)]);
  }
  /// Reference branch vector X_ab of the bond at position `bond` in row a [m]; cheaper to compute than to keep.
  Vec3 branch(Index a, Offset bond) const {
    return X[static_cast<std::size_t>(bonds.neighbour[static_cast<std::size_t>(bond)])] -
           X[static_cast<std::size_t>(a)];
  }
};

/// Appends the particles, bonds and nodes of another body of the same formulation, moving its indices up.
void append(Discretization& all, Discretization body);

/// Do the forces derive from a potential? Those of [V 42] do not, nor those of [V 43] where a face is constrained.
bool has_potential(const Discretization& d);

/// The shortest bond between particles with a common face or between a particle and its ghost [m].
double shortest_length(const Discretization& d);

/// The shortest bond of each particle [m], the length h of the artificial viscosity [D 61]; for a particle without
/// bonds the cube root of its volume.
std::vector<double> shortest_bonds(const Discretization& d);

}  // namespace tessera
