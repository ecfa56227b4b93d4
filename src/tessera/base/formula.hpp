#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// A number that may depend on time and on the material point: parsed once, evaluated often, in SI units.
/// Knows t, X, Y, Z, pi, the functions sin cos tan exp log sqrt abs min max pow (and ^), comparisons, && and ||.
/// Evaluation is not thread-safe: one formula belongs to one thread at a time.
class Formula {
 public:
  /// The constant zero.
  Formula();
  /// A constant.
  explicit Formula(double value);
  /// Parses `text`. Throws InputError at `origin`, its column moved to the fault, when the text is no formula.
  Formula(const std::string& text, const Origin& origin);

  Formula(const Formula&);
  Formula(Formula&&) noexcept;
  Formula& operator=(const Formula&);
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// The value at time t and material position X. Throws RunError when it is not finite.
  double operator()(double t, const Vec3& X) const;

  bool depends_on_time() const;
  bool depends_on_position() const;
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

inline Vec3 evaluate(const FormulaVec3& f, double t, const Vec3& X) { return {f[0](t, X), f[1](t, X), f[2](t, X)}; }

}  // namespace tessera
