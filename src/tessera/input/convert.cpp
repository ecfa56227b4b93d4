#include "tessera/input/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "tessera/base/text.hpp"
#include "tessera/input/toml_reader.hpp"

namespace tessera::input {

namespace {

[[noreturn]] void fail_type(const Parameter& p, const Value& value) {
  throw InputError(value.origin, fmt::format("found {}; expected {}", describe(value), expectation(p)));
}

Value with_data(const Value& value, decltype(Value::data) data) { return {std::move(data), value.origin}; }

void check_range(const Parameter& p, const Value& value, double number) {
  if (p.range.contains(number)) return;
  const std::string unit = si_unit(p.dimension);
  throw InputError(value.origin, fmt::format("found {}, out of range; allowed: {}{}", describe(value), p.range.text(),
                                             unit.empty() ? "" : " (in " + unit + ")"));
}

double quantity_in_text(const Parameter& p, const Value& value, const std::string& text) {
  const DimensionalResult result = read_quantity(text);
  if (!result.quantity) {
    Origin place = value.origin;
    if (place.line > 0) place.column += 1 + static_cast<int>(result.position);
    throw InputError(place, fmt::format("found {}: {}; expected {}", describe(value), result.fault, expectation(p)));
  }
  if (result.quantity->dimension == p.dimension) return result.quantity->value;
  const std::string unit = si_unit(result.quantity->dimension);
  throw InputError(value.origin,
                   fmt::format("found {}, a {}{}; expected {}", describe(value), name_of(result.quantity->dimension),
                               unit.empty() ? "" : " in " + unit, expectation(p)));
}

/// A string that is no number alone has its angle in radians by now.
double angle_in_text(const Parameter& p, const Value& value, const std::string& text) {
  const double number = quantity_in_text(p, value, text);
  const std::string_view last = trimmed(text);
  const bool has_unit = !last.empty() && std::isalpha(static_cast<unsigned char>(last.back())) != 0;
  if (!has_unit) return number;
  const double degrees = number * 180.0 / std::numbers::pi, whole = std::round(degrees);
  return std::abs(degrees - whole) < 1e-12 * std::abs(whole) ? whole : degrees;
}

double to_number(const Parameter& p, const Value& value) {
  double number = 0.0;
  if (const auto* integer = value.get_if<std::int64_t>()) {
    number = static_cast<double>(*integer);
  } else if (const auto* real = value.get_if<double>()) {
    number = *real;
  } else if (const auto* text = value.get_if<std::string>()) {
    number = p.kind == Kind::angle ? angle_in_text(p, value, *text) : quantity_in_text(p, value, *text);
  } else {
    fail_type(p, value);
  }
  if (!std::isfinite(number)) throw InputError(value.origin, fmt::format("found {}; expected a finite number", number));
  check_range(p, value, number);
  return number;
}

Value to_integer(const Parameter& p, const Value& value) {
  const auto* integer = value.get_if<std::int64_t>();
  if (integer == nullptr) fail_type(p, value);
  check_range(p, value, static_cast<double>(*integer));
  return value;
}

const std::string& to_text(const Parameter& p, const Value& value) {
  const auto* text = value.get_if<std::string>();
  if (text == nullptr) fail_type(p, value);
  return *text;
}

Value to_name(const Parameter& p, const Value& value) {
  const std::string& text = to_text(p, value);
  const bool bad = std::any_of(text.begin(), text.end(), [](unsigned char c) {
    return c < 0x20 || c == 0x7f || c == ',' || c == '"' || c == '\'';
  });
  if (bad || trimmed(text).empty()) fail_type(p, value);
  return value;
}

Value to_path(const Parameter& p, const Value& value, const Setting& setting) {
  const std::string& text = to_text(p, value);
  if (text.empty()) fail_type(p, value);
  const std::filesystem::path path = std::filesystem::absolute(std::filesystem::path(setting.directory) / text);
  return with_data(value, path.lexically_normal().string());
}

bool is_choice(const Parameter& p, const std::string& text) {
  return std::find(p.choices.begin(), p.choices.end(), text) != p.choices.end();
}

Value to_choice(const Parameter& p, const Value& value) {
  const std::string& text = to_text(p, value);
  if (is_choice(p, text)) return value;
  throw InputError(value.origin, fmt::format("found {}; expected {}{}", describe(value), expectation(p),
                                             did_you_mean(text, p.choices)));
}

Value to_step(const Parameter& p, const Value& value) {
  const auto* text = value.get_if<std::string>();
  if (text == nullptr || looks_like_quantity(*text)) return with_data(value, to_number(p, value));
  return to_choice(p, value);
}

Value to_interval(const Parameter& p, const Value& value) {
  const std::string wall = "wall";
  const auto* text = value.get_if<std::string>();
  if (text == nullptr || !trimmed(*text).ends_with(wall)) return with_data(value, to_number(p, value));
  const std::string_view all = trimmed(*text);
  const Value time = with_data(value, std::string(trimmed(all.substr(0, all.size() - wall.size()))));
  return with_data(value, fmt::format("{} s {}", to_number(p, time), wall));
}

/// "1 mm*t" reads as millimetres times tonnes, but whoever writes so means a formula.
void refuse_units_in_formula(const Parameter& p, const Value& value, const std::string& text) {
  const DimensionalResult result = read_quantity(text);
  if (!result.quantity || result.quantity->dimension == p.dimension || text.find('*') == std::string::npos) return;
  throw InputError(value.origin, fmt::format("found {}, a product of units; numbers in formulas are in SI units and "
                                             "have none behind them, as in \"1e-3*t\"",
                                             describe(value)));
}

/// A number, or the text of a formula. What starts as a number with a unit is never a formula.
Value to_formula(const Parameter& p, const Value& value) {
  const auto* text = value.get_if<std::string>();
  if (text != nullptr) refuse_units_in_formula(p, value, *text);
  if (text == nullptr || looks_like_quantity(*text)) return with_data(value, to_number(p, value));
  if (const auto result = read_quantity(*text); result.quantity && result.quantity->dimension == dimension::none)
    return with_data(value, result.quantity->value);
  return value;
}

Value to_partial_formula(const Parameter& p, const Value& value) {
  const auto* text = value.get_if<std::string>();
  if (text != nullptr && trimmed(*text) == "free") return with_data(value, std::string("free"));
  return to_formula(p, value);
}

/// The value of one component; traction and initial values know no free component.
Value to_full_formula(const Parameter& p, const Value& value) {
  const auto* text = value.get_if<std::string>();
  if (text != nullptr && trimmed(*text) == "free")
    throw InputError(value.origin, fmt::format("found \"free\"; expected {}; write 0 for none", expectation(p)));
  return to_formula(p, value);
}

const Array& to_array(const Parameter& p, const Value& value) {
  const auto* array = value.get_if<Array>();
  if (array == nullptr) fail_type(p, value);
  return *array;
}

using ConvertItem = Value (*)(const Parameter&, const Value&);

Value to_three(const Parameter& p, const Value& value, const Setting& setting, ConvertItem convert_item) {
  Array items = to_array(p, value);
  if (items.size() == 2 && setting.dimension == 2) {
    items.push_back(*read_toml_value(p.flat));
    items.back().origin = value.origin;
  }
  if (items.size() != 3)
    throw InputError(value.origin, fmt::format("found a list of {}; expected {}{}", items.size(), expectation(p),
                                               items.size() == 2 ? " (two are enough with method.dimension = 2)" : ""));
  for (Value& item : items) item = convert_item(p, item);
  return with_data(value, std::move(items));
}

Value to_rows(const Parameter& p, const Value& value, const Setting& setting) {
  Array rows = to_array(p, value);
  if (rows.size() == 2 && setting.dimension == 2) rows.push_back({Array(3, Value{0.0, value.origin}), value.origin});
  if (rows.size() != 3)
    throw InputError(value.origin, fmt::format("found a list of {}; expected {}", rows.size(), expectation(p)));
  for (Value& row : rows) row = to_three(p, row, setting, to_full_formula);
  return with_data(value, std::move(rows));
}

Value to_number_value(const Parameter& p, const Value& value) { return with_data(value, to_number(p, value)); }

Value to_factors(const Parameter& p, const Value& value, const Setting& setting) {
  if (value.get_if<Array>() != nullptr) return to_three(p, value, setting, to_number_value);
  const Value one = to_number_value(p, value);
  return with_data(value, Array{one, one, one});
}

Value to_points(const Parameter& p, const Value& value) {
  Array points = to_array(p, value);
  if (points.size() < 3)
    throw InputError(value.origin, fmt::format("found {} points; expected {}", points.size(), expectation(p)));
  for (Value& point : points) {
    Array pair = to_array(p, point);
    if (pair.size() != 2) fail_type(p, point);
    for (Value& x : pair) x = to_number_value(p, x);
    point.data = std::move(pair);
  }
  return with_data(value, std::move(points));
}

Value to_words(const Parameter& p, const Value& value) {
  for (const Value& item : to_array(p, value)) to_text(p, item);
  return value;
}

Value to_selection(const Parameter& p, const Value& value) {
  if (value.get_if<std::string>() != nullptr) return to_selection(p, with_data(value, Array{value}));
  const Array& items = to_array(p, value);
  if (items.empty()) fail_type(p, value);
  for (const Value& item : items)
    if (trimmed(to_text(p, item)).empty()) fail_type(p, item);
  return value;
}

Value to_flag(const Parameter& p, const Value& value) {
  if (value.get_if<bool>() == nullptr) fail_type(p, value);
  return value;
}

}  // namespace

Value convert(const Parameter& p, const Value& value, const Setting& setting) {
  switch (p.kind) {
    case Kind::flag:
      return to_flag(p, value);
    case Kind::integer:
      return to_integer(p, value);
    case Kind::number:
    case Kind::angle:
      return to_number_value(p, value);
    case Kind::text:
      return with_data(value, to_text(p, value));
    case Kind::name:
      return to_name(p, value);
    case Kind::path:
      return to_path(p, value, setting);
    case Kind::choice:
      return to_choice(p, value);
    case Kind::step:
      return to_step(p, value);
    case Kind::interval:
      return to_interval(p, value);
    case Kind::vector:
      return to_three(p, value, setting, to_number_value);
    case Kind::factors:
      return to_factors(p, value, setting);
    case Kind::counts:
      return to_three(p, value, setting, to_integer);
    case Kind::points:
      return to_points(p, value);
    case Kind::words:
      return to_words(p, value);
    case Kind::selection:
      return to_selection(p, value);
    case Kind::formula:
      return to_full_formula(p, value);
    case Kind::formulas:
      return to_three(p, value, setting, to_full_formula);
    case Kind::partial_formulas:
      return to_three(p, value, setting, to_partial_formula);
    case Kind::formula_rows:
      return to_rows(p, value, setting);
    case Kind::table:
    case Kind::tables:
    case Kind::shape:
    case Kind::shapes:
      break;
  }
  throw std::logic_error("no single value: " + p.key);
}

}  // namespace tessera::input
