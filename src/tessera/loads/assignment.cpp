#include "tessera/loads/assignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

bool is_load(const BoundaryCondition& c) {
  return std::holds_alternative<NominalTraction>(c.kind) || std::holds_alternative<NominalPressure>(c.kind);
}

Mat3 mask(const PartialFormulaVec3& components) {
  return diagonal(components[0] ? 1.0 : 0.0, components[1] ? 1.0 : 0.0, components[2] ? 1.0 : 0.0);
}

/// The projection that an entry asks for on a face with normal N, [V 14].
Mat3 projection(const BoundaryCondition& c, const Vec3& N) {
  if (const auto* u = std::get_if<PrescribedDisplacement>(&c.kind)) return mask(u->components);
  if (const auto* v = std::get_if<PrescribedVelocity>(&c.kind)) return mask(v->components);
  switch (std::get<Condition>(c.kind)) {
    case Condition::fixed:
      return identity();
    case Condition::symmetric:
      return outer(N, N);
    case Condition::antisymmetric:
      return identity() - outer(N, N);
    case Condition::free:
      break;
  }
  return Mat3{};
}

std::string place(const Vec3& X) { return fmt::format("({:g}, {:g}, {:g})", X.x, X.y, X.z); }

[[noreturn]] void report_conflict(const BoundaryCondition& later, const BoundaryCondition& earlier, const char* what,
                                  const Vec3& X) {
  throw InputError(later.origin,
                   fmt::format("constrains the same component of the {} at {} as the [[boundary]] entry at line {}; "
                               "let their `where` exclude each other or leave the component \"free\" in one",
                               what, place(X), earlier.origin.line));
}

[[noreturn]] void report_nothing(const BoundaryCondition& c, const Surface& surface, const char* what) {
  const std::string names = fmt::format("{}", fmt::join(surface.known_names, ", "));
  throw InputError(c.where.origin, fmt::format("takes no {} of body \"{}\", which reaches from {} to {}{}", what,
                                               surface.body, place(surface.lower), place(surface.upper),
                                               names.empty() ? std::string() : "; its sides are " + names));
}

Selection compile(const BoundaryCondition& c, const Surface& surface) {
  return Selection(c.where, surface.known_names, surface.lower, surface.upper);
}

bool overlap(const Mat3& D, const Mat3& E) {
  const Mat3 product = D * E;
  return contract(product, product) > 1e-18;
}

}  // namespace

std::vector<PointConstraint> constrain_faces(const Surface& surface,
                                             std::span<const BoundaryCondition* const> conditions) {
  std::vector<PointConstraint> faces(surface.pieces.size());
  for (const BoundaryCondition* c : conditions) {
    if (is_load(*c)) continue;
    const Selection where = compile(*c, surface);
    bool taken = false;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const SurfacePiece& piece = surface.pieces[i];
      if (!where.takes({piece.centroid, surface.names_of(piece)})) continue;
      taken = true;
      const Mat3 D = projection(*c, piece.N);
      for (const MotionPart& earlier : faces[i].parts)
        if (overlap(D, earlier.M)) report_conflict(*c, *earlier.condition, "boundary face", piece.centroid);
      if (contract(D, D) == 0.0) continue;
      faces[i].D += D;
      faces[i].parts.push_back({c, D});
    }
    if (!taken) report_nothing(*c, surface, "boundary face");
  }
  return faces;
}

std::vector<LoadedPiece> load_pieces(const Surface& surface, std::span<const BoundaryCondition* const> conditions) {
  std::vector<LoadedPiece> loaded;
  for (const BoundaryCondition* c : conditions) {
    if (!is_load(*c)) continue;
    const Selection where = compile(*c, surface);
    const std::size_t before = loaded.size();
    for (std::size_t i = 0; i < surface.pieces.size(); ++i)
      if (where.takes({surface.pieces[i].centroid, surface.names_of(surface.pieces[i])}))
        loaded.push_back({static_cast<Index>(i), c});
    if (loaded.size() == before) report_nothing(*c, surface, "boundary face");
  }
  return loaded;
}

namespace {

/// Displacement that an entry prescribes at time t, as far as a comparison of entries needs it (velocities: from the
/// start).
Vec3 displacement_at(const BoundaryCondition& c, double t, const Vec3& X) {
  Vec3 u;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (const auto* p = std::get_if<PrescribedDisplacement>(&c.kind); p && p->components[k])
      u[i] = (*p->components[k])(t, X);
    if (const auto* v = std::get_if<PrescribedVelocity>(&c.kind); v && v->components[k])
      u[i] = t * (*v->components[k])(0.5 * t, X);
  }
  return u;
}

/// Scalar constraints on one particle, made orthonormal as they come.
class ParticleConstraints {
 public:
  explicit ParticleConstraints(const Vec3& X) : X_(X) {}

  void add(const BoundaryCondition& c, const Mat3& D, double end) {
    for (const Vec3& direction : range(D)) add(c, direction, end);
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

  double value(const Row& row, double t) const {
    double s = 0.0;
    for (const MotionPart& p : row.parts) s += dot(row.direction, p.M * displacement_at(*p.condition, t, X_));
    return s;
  }

  void add(const BoundaryCondition& c, const Vec3& direction, double end) {
    Vec3 rest = direction;
    for (const Row& row : rows_) rest -= dot(direction, row.direction) * row.direction;
    if (norm(rest) < 1e-9) return check(c, direction, end);
    const double length = norm(rest);
    Row row{rest / length, {}};
    row.parts.push_back({&c, (1.0 / length) * outer(row.direction, direction)});
    for (const Row& earlier : rows_)
      for (const MotionPart& p : earlier.parts)
        row.parts.push_back({p.condition, (-dot(direction, earlier.direction) / length) *
                                              (outer(row.direction, earlier.direction) * p.M)});
    rows_.push_back(row);
  }

  /// A direction that is constrained already must have been given the same motion.
  void check(const BoundaryCondition& c, const Vec3& direction, double end) const {
    for (const double t : {0.0, 0.37 * end, end}) {
      double expected = 0.0, size = 1e-30;
      for (const Row& row : rows_) expected += dot(direction, row.direction) * value(row, t);
      const double wanted = dot(direction, displacement_at(c, t, X_));
      size = std::max({size, std::abs(expected), std::abs(wanted)});
      if (std::abs(expected - wanted) > 1e-9 * size) report_conflict(c, holder_of(direction), "particle", X_);
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

/// What an entry takes of a surface whose corners are particles.
struct Taken {
  std::vector<char> piece, particle;
};

bool is_among(const std::vector<Vec3>& normals, const Vec3& N) {
  return std::any_of(normals.begin(), normals.end(), [&](const Vec3& n) { return norm(n - N) < 1e-6; });
}

/// Distinct normals of the pieces around each particle that an entry takes. A particle at the rim of a formula may
/// have no whole piece; it takes the normals that it shares with the rest of the entry.
std::vector<std::vector<Vec3>> selected_normals(const Surface& surface, const Taken& taken) {
  std::vector<std::vector<Vec3>> normals(taken.particle.size());
  const auto note = [&](const SurfacePiece& piece, const auto& wants) {
    for (Index a : piece.vertices) {
      auto& list = normals[static_cast<std::size_t>(a)];
      if (wants(static_cast<std::size_t>(a)) && !is_among(list, piece.N)) list.push_back(piece.N);
    }
  };
  for (std::size_t i = 0; i < surface.pieces.size(); ++i)
    if (taken.piece[i]) note(surface.pieces[i], [](std::size_t) { return true; });

  std::vector<char> at_rim(normals.size(), 0);
  for (std::size_t a = 0; a < normals.size(); ++a) at_rim[a] = taken.particle[a] && normals[a].empty() ? 1 : 0;
  if (std::find(at_rim.begin(), at_rim.end(), 1) == at_rim.end()) return normals;
  std::vector<Vec3> of_entry;
  for (std::size_t i = 0; i < surface.pieces.size(); ++i)
    if (taken.piece[i] && !is_among(of_entry, surface.pieces[i].N)) of_entry.push_back(surface.pieces[i].N);
  for (const SurfacePiece& piece : surface.pieces)
    if (is_among(of_entry, piece.N)) note(piece, [&](std::size_t a) { return at_rim[a] != 0; });
  return normals;
}

bool needs_normals(const BoundaryCondition& c) {
  const auto* condition = std::get_if<Condition>(&c.kind);
  return condition != nullptr && (*condition == Condition::symmetric || *condition == Condition::antisymmetric);
}

[[noreturn]] void report_no_normal(const BoundaryCondition& c, const Vec3& X) {
  throw InputError(c.where.origin,
                   fmt::format("takes the particle at {} but no boundary triangle around it as a whole, so there is no "
                               "normal to be symmetric or antisymmetric about; take a side by name or more particles",
                               place(X)));
}

/// The projection onto all directions that an entry constrains, given the normals of its pieces at the particle.
Mat3 span_of(const BoundaryCondition& c, const std::vector<Vec3>& normals) {
  if (!needs_normals(c)) return projection(c, Vec3{});
  Mat3 D;
  for (const Vec3& N : normals) {
    const Mat3 E = projection(c, N);
    for (int i = 0; i < 3; ++i) {
      Vec3 v{E(0, i), E(1, i), E(2, i)};
      v -= D * v;
      if (norm(v) > 1e-9) D += outer(normalized(v), normalized(v));
    }
  }
  return D;
}

Taken take(const BoundaryCondition& c, const Surface& surface, std::span<const Vec3> X) {
  const Selection where = compile(c, surface);
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
    const auto normals = selected_normals(surface, taken);
    for (std::size_t a = 0; a < X.size(); ++a) {
      if (!taken.particle[a]) continue;
      if (needs_normals(*c) && normals[a].empty()) report_no_normal(*c, X[a]);
      constraints[a].add(*c, span_of(*c, normals[a]), end);
    }
  }
  std::vector<PointConstraint> result;
  for (const ParticleConstraints& p : constraints) result.push_back(p.result());
  return result;
}

}  // namespace tessera
