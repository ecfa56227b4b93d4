#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tessera/loads/assignment.hpp"
#include "tessera/loads/condition_values.hpp"
#include "tessera/loads/selected.hpp"
#include "tessera/loads/side_normals.hpp"

namespace tessera {

namespace {

/// Displacement that an entry prescribes at time t, as far as a comparison of entries needs it (velocities: from the
/// start).
Vec3 displacement_at(const BoundaryCondition& c, double t, const Vec3& X) {
  if (std::holds_alternative<PrescribedVelocity>(c.kind)) return t * MotionValues(c, 0.5 * t).at(X);
  return MotionValues(c, t).at(X);
}

/// Scalar constraints on one particle, made orthonormal as they come.
class ParticleConstraints {
 public:
  explicit ParticleConstraints(const Vec3& X) : X_(X) {}

  void add(const BoundaryCondition& c, const HeldDirections& held, double end) {
    for (const Vec3& direction : range(held.D)) add({&c, held.M}, direction, end);
  }

  PointConstraint result() const {
    PointConstraint r;
    for (const Row& row : rows_) {
      r.D += outer(row.direction, row.direction);
      for (const MotionPart& part : row.parts) {
        const auto same = std::find_if(r.parts.begin(), r.parts.end(),
                                       [&](const MotionPart& p) { return p.condition == part.condition; });
        if (same != r.parts.end())
          same->M += part.M;
        else
          r.parts.push_back(part);
      }
    }
    return r;
  }

 private:
  /// direction . u = sum over the parts of direction . (M u_condition).
  struct Row {
    Vec3 direction;
    std::vector<MotionPart> parts;
  };

  static std::vector<Vec3> range(const Mat3& D) {
    std::vector<Vec3> basis;
    for (int i = 0; i < 3; ++i) {
      Vec3 v{D(0, i), D(1, i), D(2, i)};
      for (const Vec3& b : basis) v -= dot(v, b) * b;
      if (norm(v) > 1e-9) basis.push_back(normalized(v));
    }
    return basis;
  }

  /// What a row prescribes, and the size of the displacements that it is made of.
  std::array<double, 2> value(const Row& row, double t) const {
    double s = 0.0, size = 0.0;
    for (const MotionPart& p : row.parts) {
      const Vec3 u = displacement_at(*p.condition, t, X_);
      s += dot(row.direction, p.M * u);
      size = std::max(size, norm(u));
    }
    return {s, size};
  }

  void add(const MotionPart& given, const Vec3& direction, double end) {
    Vec3 rest = direction;
    for (const Row& row : rows_) rest -= dot(direction, row.direction) * row.direction;
    if (norm(rest) < 1e-9) return check(given, direction, end);
    const double length = norm(rest);
    Row row{rest / length, {}};
    row.parts.push_back({given.condition, (1.0 / length) * (outer(row.direction, direction) * given.M)});
    for (const Row& earlier : rows_)
      for (const MotionPart& p : earlier.parts)
        row.parts.push_back({p.condition, (-dot(direction, earlier.direction) / length) *
                                              (outer(row.direction, earlier.direction) * p.M)});
    rows_.push_back(row);
  }

  /// A direction that is constrained already must have been given the same motion.
  void check(const MotionPart& given, const Vec3& direction, double end) const {
    for (const double t : {0.0, 0.37 * end, end}) {
      const Vec3 u = displacement_at(*given.condition, t, X_);
      const double wanted = dot(direction, given.M * u);
      double expected = 0.0, size = std::max(1e-30, norm(u));
      for (const Row& row : rows_) {
        const auto [held, size_of_row] = value(row, t);
        expected += dot(direction, row.direction) * held;
        size = std::max(size, size_of_row);
      }
      if (std::abs(expected - wanted) > 1e-9 * size)
        report_conflict(*given.condition, holder_of(direction), "particle", X_);
    }
  }

  /// The entry that holds most of a direction.
  const BoundaryCondition& holder_of(const Vec3& direction) const {
    const auto share = [&](const Row& row) { return std::abs(dot(row.direction, direction)); };
    const auto row =
        std::max_element(rows_.begin(), rows_.end(), [&](const Row& l, const Row& r) { return share(l) < share(r); });
    return *row->parts.front().condition;
  }

  Vec3 X_;
  std::vector<Row> rows_;
};

[[noreturn]] void report_no_normal(const BoundaryCondition& c, const Vec3& X) {
  throw InputError(c.where.origin,
                   fmt::format("takes the particle at {} but no boundary triangle around it as a whole, so there is no "
                               "normal to tell directions by; take a side by name or more particles",
                               place(X)));
}

Taken take(const BoundaryCondition& c, const Surface& surface, std::span<const Vec3> X) {
  const Selection where = selection_of(c, surface);
  Taken taken{std::vector<char>(surface.pieces.size(), 0), std::vector<char>(X.size(), 0)};
  for (const SurfacePiece& piece : surface.pieces)
    for (Index a : piece.vertices) {
      char& t = taken.particle[static_cast<std::size_t>(a)];
      if (!t) t = where.takes({X[static_cast<std::size_t>(a)], surface.names_of(piece)}) ? 1 : 0;
    }
  // A piece belongs to an entry when the entry takes it by name, or takes all its corners by formula.
  for (std::size_t i = 0; i < surface.pieces.size(); ++i) {
    const SurfacePiece& piece = surface.pieces[i];
    taken.piece[i] = std::all_of(piece.vertices.begin(), piece.vertices.end(), [&](Index a) {
      return where.takes({X[static_cast<std::size_t>(a)], surface.names_of(piece)});
    });
  }
  return taken;
}

}  // namespace

std::vector<PointConstraint> constrain_particles(const Surface& surface, std::span<const Vec3> X,
                                                 std::span<const BoundaryCondition* const> conditions, double end) {
  std::vector<ParticleConstraints> constraints;
  for (const Vec3& x : X) constraints.emplace_back(x);
  for (const BoundaryCondition* c : conditions) {
    if (is_load(*c)) continue;
    const Taken taken = take(*c, surface, X);
    if (std::none_of(taken.particle.begin(), taken.particle.end(), [](char t) { return t; }))
      report_nothing(*c, surface, "boundary particle");
    const auto normals =
        needs_normal(*c) ? side_normals(surface, X, taken) : std::vector<std::vector<Vec3>>(X.size(), {Vec3{}});
    for (std::size_t a = 0; a < X.size(); ++a) {
      if (!taken.particle[a]) continue;
      if (normals[a].empty()) report_no_normal(*c, X[a]);
      for (const Vec3& N : normals[a]) constraints[a].add(*c, held_directions(*c, N), end);
    }
  }
  std::vector<PointConstraint> result;
  for (const ParticleConstraints& p : constraints) result.push_back(p.result());
  return result;
}

}  // namespace tessera
