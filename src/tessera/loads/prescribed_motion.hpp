#pragma once

#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/loads/assignment.hpp"
#include "tessera/loads/condition_values.hpp"

namespace tessera {

/// Points whose motion is prescribed: the walls of boundary nodes (voronoi) or particles (delaunay).
class PrescribedMotion {
 public:
  /// `X` are the points' reference positions, `initial` their displacements at time zero, from which prescribed
  /// velocities start [m]. `spreads`, if any, has one entry a point: those of faces over which motion is averaged.
  PrescribedMotion(std::vector<Vec3> X, std::vector<PointConstraint> constraints, std::span<const Vec3> initial,
                   std::vector<FaceSpread> spreads = {});
  PrescribedMotion() = default;

  /// Moves the points to time t. Velocities are integrated over the time since the last call by the midpoint rule.
  void move_to(double t);

  /// Current positions X + u_bar(t); components that are not prescribed stay at their reference [m].
  std::span<const Vec3> positions() const { return positions_; }

  /// What a resumed run must put back: time and integrated displacements.
  double time() const { return time_; }
  const std::vector<Vec3>& integrated() const { return integrated_; }
  void restore(double time, std::vector<Vec3> integrated);

 private:
  /// One entry at one point: positions_[point] += M u.
  struct Part {
    std::size_t point;
    Mat3 M;
  };
  /// All points of one [[boundary]] entry, so that a formula without X, Y, Z is evaluated once.
  struct Group {
    const BoundaryCondition* condition;
    std::vector<Part> parts;
    std::size_t first_integrated;  // of the parts' integrated displacements (velocities only)
  };

  void place();
  /// At a point, or the mean over its face.
  Vec3 mean_at(const MotionValues& values, std::size_t point) const;

  std::vector<Vec3> X_, positions_;
  std::vector<FaceSpread> spreads_;
  std::vector<Group> groups_;
  std::vector<Vec3> integrated_;
  double time_ = 0.0;
};

}  // namespace tessera
