#include "tessera/loads/prescribed_motion.hpp"

#include <algorithm>

namespace tessera {

namespace {

/// Evaluates components at many points; components that do not depend on the position are evaluated once.
class Evaluator {
 public:
  Evaluator(const PartialFormulaVec3& components, double t) : components_(components), t_(t) {
    for (std::size_t i = 0; i < 3; ++i)
      if (components[i] && !components[i]->depends_on_position())
        everywhere_[static_cast<int>(i)] = (*components[i])(t, Vec3{});
  }

  Vec3 at(const Vec3& X) const {
    Vec3 u = everywhere_;
    for (std::size_t i = 0; i < 3; ++i)
      if (components_[i] && components_[i]->depends_on_position()) u[static_cast<int>(i)] = (*components_[i])(t_, X);
    return u;
  }

 private:
  const PartialFormulaVec3& components_;
  double t_;
  Vec3 everywhere_;
};

}  // namespace

PrescribedMotion::PrescribedMotion(std::vector<Vec3> X, std::vector<PointConstraint> constraints,
                                   std::span<const Vec3> initial)
    : X_(std::move(X)), positions_(X_) {
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

void PrescribedMotion::move_to(double t) {
  const double dt = t - time_, middle = time_ + 0.5 * dt;
  for (const Group& g : groups_) {
    const auto* velocity = std::get_if<PrescribedVelocity>(&g.condition->kind);
    if (velocity == nullptr || dt == 0.0) continue;
    const Evaluator v(velocity->components, middle);
    for (std::size_t k = 0; k < g.parts.size(); ++k)
      integrated_[g.first_integrated + k] += dt * v.at(X_[g.parts[k].point]);
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
    } else if (const auto* displacement = std::get_if<PrescribedDisplacement>(&g.condition->kind)) {
      const Evaluator u(displacement->components, time_);
      for (const Part& p : g.parts) positions_[p.point] += p.M * u.at(X_[p.point]);
    }
  }
}

void PrescribedMotion::restore(double time, std::vector<Vec3> integrated) {
  time_ = time;
  integrated_ = std::move(integrated);
  place();
}

}  // namespace tessera
