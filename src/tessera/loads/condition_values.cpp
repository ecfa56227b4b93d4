#include "tessera/loads/condition_values.hpp"

#include <cmath>

namespace tessera {

namespace {

template <class Kind>
const Kind* as(const BoundaryCondition& c) {
  return std::get_if<Kind>(&c.kind);
}

std::array<const Formula*, 3> addresses(const FormulaVec3& f) { return {&f[0], &f[1], &f[2]}; }

std::array<const Formula*, 3> addresses(const PartialFormulaVec3& f) {
  std::array<const Formula*, 3> list{};
  for (std::size_t i = 0; i < 3; ++i)
    if (f[i]) list[i] = &*f[i];
  return list;
}

Mat3 mask(const PartialFormulaVec3& components) {
  return diagonal(components[0] ? 1.0 : 0.0, components[1] ? 1.0 : 0.0, components[2] ? 1.0 : 0.0);
}

HeldDirections whole(const Mat3& D) { return {D, D}; }

}  // namespace

bool is_load(const BoundaryCondition& c) {
  return as<NominalTraction>(c) || as<NominalPressure>(c) || as<NominalStress>(c) || as<FollowingPressure>(c);
}

bool needs_normal(const BoundaryCondition& c) {
  if (const auto* condition = as<Condition>(c))
    return *condition == Condition::symmetric || *condition == Condition::antisymmetric;
  return as<NormalDisplacement>(c) || as<TangentialDisplacement>(c);
}

HeldDirections held_directions(const BoundaryCondition& c, const Vec3& N) {
  const Mat3 NN = outer(N, N);
  if (const auto* u = as<PrescribedDisplacement>(c)) return whole(mask(u->components));
  if (const auto* v = as<PrescribedVelocity>(c)) return whole(mask(v->components));
  if (as<PrescribedRotation>(c)) return whole(identity());
  if (as<NormalDisplacement>(c)) return {NN, outer(N, {1, 0, 0})};
  if (as<TangentialDisplacement>(c)) return whole(identity() - NN);
  switch (std::get<Condition>(c.kind)) {
    case Condition::fixed:
      return whole(identity());
    case Condition::symmetric:
      return whole(NN);
    case Condition::antisymmetric:
      return whole(identity() - NN);
    case Condition::free:
      break;
  }
  return {};
}

Mat3 rotation_about(const Vec3& axis, double angle) {
  const Mat3 K{{0, -axis.z, axis.y, axis.z, 0, -axis.x, -axis.y, axis.x, 0}};
  const double half = std::sin(0.5 * angle);  // 1 - cos without cancellation
  return identity() + std::sin(angle) * K + 2.0 * half * half * (K * K);
}

MotionValues::MotionValues(const BoundaryCondition& c, double t) : t_(t) {
  if (const auto* u = as<PrescribedDisplacement>(c)) components_ = addresses(u->components);
  if (const auto* v = as<PrescribedVelocity>(c)) components_ = addresses(v->components);
  if (const auto* u = as<TangentialDisplacement>(c)) components_ = addresses(u->components);
  if (const auto* u = as<NormalDisplacement>(c)) components_[0] = &u->value;
  if ((rotation_ = as<PrescribedRotation>(c)) != nullptr) {
    components_ = addresses(rotation_->displacement);
    if (!rotation_->angle.depends_on_position()) R_ = rotation_about(rotation_->axis, rotation_->angle(t, Vec3{}));
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (components_[i] && !components_[i]->depends_on_position())
      everywhere_[static_cast<int>(i)] = (*components_[i])(t, Vec3{});
}

Vec3 MotionValues::at(const Vec3& X) const {
  Vec3 u = everywhere_;
  for (std::size_t i = 0; i < 3; ++i)
    if (components_[i] && components_[i]->depends_on_position()) u[static_cast<int>(i)] = (*components_[i])(t_, X);
  if (rotation_ == nullptr) return u;
  const bool varies = rotation_->angle.depends_on_position();
  const Mat3 R = varies ? rotation_about(rotation_->axis, rotation_->angle(t_, X)) : R_;
  return u + (R - identity()) * (X - rotation_->point);
}

TractionValues::TractionValues(const BoundaryCondition& c, double t) : t_(t) {
  if (const auto* T = as<NominalTraction>(c)) rows_[0] = &T->components;
  if (const auto* P = as<NominalStress>(c))
    for (std::size_t i = 0; i < 3; ++i) rows_[i] = &P->rows[i];
  if (const auto* p = as<NominalPressure>(c)) pressure_ = &p->pressure;
  if (const auto* p = as<FollowingPressure>(c)) pressure_ = &p->pressure;
  if (pressure_ != nullptr && !pressure_->depends_on_position()) pressure_everywhere_ = (*pressure_)(t, Vec3{});
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; rows_[i] != nullptr && k < 3; ++k)
      if (const Formula& f = (*rows_[i])[static_cast<std::size_t>(k)]; !f.depends_on_position())
        everywhere_[i][k] = f(t, Vec3{});
}

double TractionValues::pressure_at(const Vec3& X, const Vec3& N) const {
  return pressure_->depends_on_position() ? (*pressure_)(t_, X, N) : pressure_everywhere_;
}

Vec3 TractionValues::at(const Vec3& X, const Vec3& N) const {
  if (pressure_ != nullptr) return -pressure_at(X, N) * N;
  std::array<Vec3, 3> rows = everywhere_;
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; rows_[i] != nullptr && k < 3; ++k)
      if (const Formula& f = (*rows_[i])[static_cast<std::size_t>(k)]; f.depends_on_position())
        rows[i][k] = f(t_, X, N);
  if (rows_[1] == nullptr) return rows[0];
  return {dot(rows[0], N), dot(rows[1], N), dot(rows[2], N)};
}

}  // namespace tessera
