#pragma once

#include <array>

#include "tessera/base/mat3.hpp"
#include "tessera/loads/boundary_condition.hpp"

namespace tessera {

/// Does the entry load the boundary? The others constrain its motion.
bool is_load(const BoundaryCondition& c);

/// Does an entry's constraint depend on the direction of the face?
bool needs_normal(const BoundaryCondition& c);

/// What an entry holds at a point of the boundary: the projection D onto the constrained directions, [V 14], and the
/// motion there, D u_bar = M u with the entry's vector u.
struct HeldDirections {
  Mat3 D, M;
};

/// The directions that an entry holds on a face with the normal N.
HeldDirections held_directions(const BoundaryCondition& c, const Vec3& N);

/// The rotation by `angle` [rad] about a unit vector, right-handed (Rodrigues' formula).
Mat3 rotation_about(const Vec3& axis, double angle);

/// An entry's vector u at one time and many points: displacements [m], or velocities [m/s] for PrescribedVelocity; a
/// normal displacement is the vector (value, 0, 0). What does not depend on the point is evaluated once. Components
/// that are not prescribed are zero. The entry must outlive it.
class MotionValues {
 public:
  MotionValues(const BoundaryCondition& c, double t);
  Vec3 at(const Vec3& X) const;

 private:
  std::array<const Formula*, 3> components_{};
  const PrescribedRotation* rotation_ = nullptr;
  double t_;
  Vec3 everywhere_;
  Mat3 R_;
};

/// A load's nominal traction at one time and many places [Pa], or, of a pressure that follows, only -p N: what it is as
/// long as the face has not moved. What does not depend on the place is evaluated once. The entry must outlive it.
class TractionValues {
 public:
  TractionValues(const BoundaryCondition& c, double t);
  Vec3 at(const Vec3& X, const Vec3& N) const;
  /// The pressure, for NominalPressure and FollowingPressure only [Pa].
  double pressure_at(const Vec3& X, const Vec3& N) const;

 private:
  std::array<const FormulaVec3*, 3> rows_{};  // one, the traction, or three, of the stress
  const Formula* pressure_ = nullptr;
  double t_;
  std::array<Vec3, 3> everywhere_;
  double pressure_everywhere_ = 0.0;
};

}  // namespace tessera
