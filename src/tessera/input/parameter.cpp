#include "tessera/input/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/text.hpp"

namespace tessera::input {

namespace {

/// "a length in m" or "a number".
std::string noun(const Dimension& d) {
  const std::string unit = si_unit(d);
  const std::string name = name_of(d);
  return fmt::format("{} {}{}", name[0] == 'a' || name[0] == 'e' ? "an" : "a", name, unit.empty() ? "" : " in " + unit);
}

std::string with_examples(const Dimension& d) { return fmt::format("{}, as in {}", noun(d), examples_of(d)); }

std::string formula_text(const Parameter& p) {
  const char* normal = p.names == FormulaNames::face ? ", nx, ny, nz" : "";
  return fmt::format("{}, a constant with a unit, or a formula in t, X, Y, Z{}", noun(p.dimension), normal);
}

std::string kind_text(const Parameter& p) {
  switch (p.kind) {
    case Kind::table:
    case Kind::shape:
      return "a table";
    case Kind::tables:
    case Kind::shapes:
      return "a list of tables";
    case Kind::flag:
      return "true or false";
    case Kind::integer:
      return "an integer";
    case Kind::number:
      return with_examples(p.dimension);
    case Kind::angle:
      return "an angle in degrees, as in \"30 deg\", \"0.5 rad\" or 30";
    case Kind::text:
      return "a string";
    case Kind::name:
      return "a name, a string without quotes, commas and control characters";
    case Kind::path:
      return "a file name, relative to the case file";
    case Kind::choice:
      return quoted_list(p.choices);
    case Kind::step:
      return fmt::format("{}, or {}", quoted_list(p.choices), with_examples(p.dimension));
    case Kind::interval:
      return with_examples(p.dimension) + ", or wall-clock time, as in \"60 s wall\"";
    case Kind::vector:
      return fmt::format("a list of three, each {}", with_examples(p.dimension));
    case Kind::factors:
      return "a number, or a list of three";
    case Kind::counts:
      return "a list of three integers";
    case Kind::points:
      return fmt::format("a list of at least three pairs [x, y], each {}", with_examples(p.dimension));
    case Kind::words:
      return "a list of strings";
    case Kind::selection:
      return "a string or a list of strings";
    case Kind::formula:
      return formula_text(p);
    case Kind::formulas:
      return "a list of three, each " + formula_text(p);
    case Kind::formula_rows:
      return "a list of three rows of three, each " + formula_text(p);
    case Kind::partial_formulas:
      return fmt::format("a list of three, each {}, a constant with a unit, a formula in t, X, Y, Z, or \"free\"",
                         noun(p.dimension));
  }
  return {};
}

}  // namespace

bool Range::contains(double x) const {
  return (lower == End::open ? x > min : x >= min) && (upper == End::open ? x < max : x <= max);
}

std::string Range::text() const {
  std::string result;
  if (std::isfinite(min)) result = fmt::format("{} {}", lower == End::open ? ">" : ">=", min);
  if (std::isfinite(max))
    result += fmt::format("{}{} {}", result.empty() ? "" : " and ", upper == End::open ? "<" : "<=", max);
  return result;
}

const Parameter* find_parameter(const std::string& key) {
  const auto rows = parameters();
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Parameter& p) { return p.key == key; });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<const Parameter*> parameters_in(const std::string& table) {
  const std::string prefix = table.empty() ? "" : table + ".";
  std::vector<const Parameter*> result;
  for (const Parameter& p : parameters())
    if (p.key.starts_with(prefix) && p.key.find('.', prefix.size()) == std::string::npos) result.push_back(&p);
  return result;
}

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

std::string expectation(const Parameter& parameter) {
  const std::string range = parameter.range.text();
  return kind_text(parameter) + (range.empty() ? "" : "; allowed: " + range);
}

std::string condition_text(const std::string& condition) {
  const auto equals = condition.find('=');
  if (equals == std::string::npos) return condition;
  return fmt::format("{} = {}", condition.substr(0, equals), quoted(condition.substr(equals + 1)));
}

std::string conditions_text(const Parameter& parameter) {
  std::vector<std::string> conditions;
  for (const std::string& c : parameter.only_with) conditions.push_back(condition_text(c));
  return list_of(conditions);
}

}  // namespace tessera::input
