#include "tessera/input/reader.hpp"

#include <stdexcept>

namespace tessera::input {

namespace {

template <class T>
const T& as(const Value& value) {
  if (const T* data = value.get_if<T>()) return *data;
  throw std::logic_error("unexpected type of " + value.origin.key);
}

Formula formula_of(const Value& value, FormulaNames names = FormulaNames::point) {
  if (const auto* text = value.get_if<std::string>()) return Formula(*text, value.origin, names);
  return Formula(number_of(value));
}

FormulaVec3 formulas_of(const Value& value, FormulaNames names) {
  const Array& items = as<Array>(value);
  return {formula_of(items.at(0), names), formula_of(items.at(1), names), formula_of(items.at(2), names)};
}

}  // namespace

double number_of(const Value& value) {
  if (const auto* integer = value.get_if<std::int64_t>()) return static_cast<double>(*integer);
  return as<double>(value);
}

Reader::Reader(const Value& table) : table_(&as<Table>(table)), origin_(table.origin) {}

const Value& Reader::value(const std::string& key) const {
  if (const Value* found = find(*table_, key)) return *found;
  throw std::logic_error("no key " + key + " in " + origin_.key);
}

std::vector<Reader> Reader::tables(const std::string& key) const {
  std::vector<Reader> result;
  if (has(key))
    for (const Value& item : as<Array>(value(key))) result.emplace_back(item);
  return result;
}

double Reader::number(const std::string& key) const { return number_of(value(key)); }

std::optional<double> Reader::optional_number(const std::string& key) const {
  return has(key) ? std::optional(number(key)) : std::nullopt;
}

std::int64_t Reader::integer(const std::string& key) const { return as<std::int64_t>(value(key)); }
bool Reader::flag(const std::string& key) const { return as<bool>(value(key)); }
const std::string& Reader::text(const std::string& key) const { return as<std::string>(value(key)); }
std::string Reader::text_or_empty(const std::string& key) const { return has(key) ? text(key) : std::string(); }

std::vector<std::string> Reader::words(const std::string& key) const {
  std::vector<std::string> result;
  for (const Value& item : as<Array>(value(key))) result.push_back(as<std::string>(item));
  return result;
}

Vec3 Reader::vector(const std::string& key) const {
  const Array& items = as<Array>(value(key));
  return {number_of(items.at(0)), number_of(items.at(1)), number_of(items.at(2))};
}

SelectionSpec Reader::selection(const std::string& key) const { return {words(key), origin_of(key)}; }

Formula Reader::formula(const std::string& key, FormulaNames names) const { return formula_of(value(key), names); }

FormulaVec3 Reader::formulas(const std::string& key, FormulaNames names) const {
  return formulas_of(value(key), names);
}

std::array<FormulaVec3, 3> Reader::formula_rows(const std::string& key, FormulaNames names) const {
  const Array& rows = as<Array>(value(key));
  return {formulas_of(rows.at(0), names), formulas_of(rows.at(1), names), formulas_of(rows.at(2), names)};
}

PartialFormulaVec3 Reader::partial_formulas(const std::string& key) const {
  const Array& items = as<Array>(value(key));
  PartialFormulaVec3 result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto* text = items.at(i).get_if<std::string>();
    if (text == nullptr || *text != "free") result[i] = formula_of(items[i]);
  }
  return result;
}

}  // namespace tessera::input
