#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tessera/base/formula.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/geometry/selection.hpp"
#include "tessera/input/value.hpp"

namespace tessera::input {

/// Access to one table of a normalized tree. Asking for a key that is not there, or for another type than the input
/// table says, is a mistake in the program and throws std::logic_error.
class Reader {
 public:
  explicit Reader(const Value& table);
  Reader(const Table& table, const Origin& origin) : table_(&table), origin_(origin) {}

  const Origin& origin() const { return origin_; }
  bool has(const std::string& key) const { return find(*table_, key) != nullptr; }
  const Value& value(const std::string& key) const;
  const Origin& origin_of(const std::string& key) const { return value(key).origin; }

  Reader table(const std::string& key) const { return Reader(value(key)); }
  /// The items of an array of tables; none when the key is missing.
  std::vector<Reader> tables(const std::string& key) const;

  double number(const std::string& key) const;
  std::optional<double> optional_number(const std::string& key) const;
  std::int64_t integer(const std::string& key) const;
  bool flag(const std::string& key) const;
  const std::string& text(const std::string& key) const;
  /// Empty when the key is missing.
  std::string text_or_empty(const std::string& key) const;
  std::vector<std::string> words(const std::string& key) const;
  Vec3 vector(const std::string& key) const;
  SelectionSpec selection(const std::string& key) const;
  Formula formula(const std::string& key, FormulaNames names = FormulaNames::point) const;
  FormulaVec3 formulas(const std::string& key, FormulaNames names = FormulaNames::point) const;
  std::array<FormulaVec3, 3> formula_rows(const std::string& key, FormulaNames names) const;
  PartialFormulaVec3 partial_formulas(const std::string& key) const;

 private:
  const Table* table_;
  Origin origin_;
};

/// The number of a normalized value.
double number_of(const Value& value);

}  // namespace tessera::input
