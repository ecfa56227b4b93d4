#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// What a formula may depend on: time and the material point; for what acts on a face, its reference normal, too.
enum class FormulaNames { point, face };

/// A number that may depend on time and on the material point: parsed once, evaluated often, in SI units.
/// Knows t, X, Y, Z, pi, the functions sin cos tan exp log sqrt abs min max pow (and ^), comparisons, && and ||; with
/// FormulaNames::face also nx, ny, nz, the components of the outward unit normal in the reference state.
/// Evaluation is not thread-safe: one formula belongs to one thread at a time.
class Formula {
 public:
  /// The constant zero.
  Formula();
  /// A constant.
  explicit Formula(double value);
  /// Parses `text`. Throws InputError at `origin`, its column moved to the fault, when the text is no formula.
  Formula(const std::string& text, const Origin& origin, FormulaNames names = FormulaNames::point);

  Formula(const Formula&);
  Formula(Formula&&) noexcept;
  Formula& operator=(const Formula&);
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// The value at time t and material position X. Throws when it is not finite: InputError at t = 0, RunError later.
  double operator()(double t, const Vec3& X) const { return (*this)(t, X, Vec3{}); }
  /// The same on a face with the outward unit normal N.
  double operator()(double t, const Vec3& X, const Vec3& N) const;

  bool depends_on_time() const;
  bool depends_on_position() const;  // or on the normal
  bool is_constant() const { return !depends_on_time() && !depends_on_position(); }
  /// The text as written (or the constant, printed so that it reads back to the same number).
  const std::string& text() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

using FormulaVec3 = std::array<Formula, 3>;

/// Components that are not prescribed ("free") hold nothing.
using PartialFormulaVec3 = std::array<std::optional<Formula>, 3>;

inline Vec3 evaluate(const FormulaVec3& f, double t, const Vec3& X, const Vec3& N = {}) {
  return {f[0](t, X, N), f[1](t, X, N), f[2](t, X, N)};
}

}  // namespace tessera
