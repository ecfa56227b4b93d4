#include "tessera/loads/prescribed_motion.hpp"

#include <algorithm>

#include "tessera/loads/condition_values.hpp"

namespace tessera {

PrescribedMotion::PrescribedMotion(std::vector<Vec3> X, std::vector<PointConstraint> constraints,
                                   std::span<const Vec3> initial, std::vector<FaceSpread> spreads)
    : X_(std::move(X)), positions_(X_), spreads_(std::move(spreads)) {
  for (std::size_t i = 0; i < constraints.size(); ++i)
    for (const MotionPart& part : constraints[i].parts) {
      auto group =
          std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.condition == part.condition; });
      if (group == groups_.end()) group = groups_.insert(groups_.end(), {part.condition, {}, 0});
      group->parts.push_back({i, part.M});
    }
  for (Group& g : groups_) {
    g.first_integrated = integrated_.size();
    if (!std::holds_alternative<PrescribedVelocity>(g.condition->kind)) continue;
    for (const Part& p : g.parts) integrated_.push_back(initial[p.point]);
  }
  place();
}

Vec3 PrescribedMotion::mean_at(const MotionValues& values, std::size_t point) const {
  if (spreads_.empty()) return values.at(X_[point]);
  return spreads_[point].mean(X_[point], [&](const Vec3& X) { return values.at(X); });
}

void PrescribedMotion::move_to(double t) {
  const double dt = t - time_, middle = time_ + 0.5 * dt;
  for (const Group& g : groups_) {
    if (!std::holds_alternative<PrescribedVelocity>(g.condition->kind) || dt == 0.0) continue;
    const MotionValues v(*g.condition, middle);
    for (std::size_t k = 0; k < g.parts.size(); ++k)
      integrated_[g.first_integrated + k] += dt * mean_at(v, g.parts[k].point);
  }
  time_ = t;
  place();
}

void PrescribedMotion::place() {
  positions_ = X_;
  for (const Group& g : groups_) {
    if (std::holds_alternative<PrescribedVelocity>(g.condition->kind)) {
      for (std::size_t k = 0; k < g.parts.size(); ++k)
        positions_[g.parts[k].point] += g.parts[k].M * integrated_[g.first_integrated + k];
    } else {
      const MotionValues u(*g.condition, time_);
      for (const Part& p : g.parts) positions_[p.point] += p.M * mean_at(u, p.point);
    }
  }
}

void PrescribedMotion::restore(double time, std::vector<Vec3> integrated) {
  time_ = time;
  integrated_ = std::move(integrated);
  place();
}

}  // namespace tessera
