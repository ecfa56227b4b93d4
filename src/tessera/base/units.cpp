#include "tessera/base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

#include "tessera/base/text.hpp"

namespace tessera {

namespace {

/// A unit as 10^exponent times factor times base units; exact powers of ten stay apart so that they can be applied to
/// the decimal digits of a number.
struct Unit {
  int exponent = 0;
  double factor = 1.0;
  Dimension dimension;
};

enum class Prefixes { allowed, none };

struct NamedUnit {
  std::string_view name;
  Unit unit;
  Prefixes prefixes;
};

constexpr NamedUnit units[] = {
    {"m", {0, 1.0, {1, 0, 0}}, Prefixes::allowed},
    {"g", {-3, 1.0, {0, 1, 0}}, Prefixes::allowed},
    {"s", {0, 1.0, {0, 0, 1}}, Prefixes::allowed},
    {"N", {0, 1.0, {1, 1, -2}}, Prefixes::allowed},
    {"Pa", {0, 1.0, {-1, 1, -2}}, Prefixes::allowed},
    {"J", {0, 1.0, {2, 1, -2}}, Prefixes::allowed},
    {"W", {0, 1.0, {2, 1, -3}}, Prefixes::allowed},
    {"Hz", {0, 1.0, {0, 0, -1}}, Prefixes::allowed},
    {"bar", {5, 1.0, {-1, 1, -2}}, Prefixes::allowed},
    {"t", {3, 1.0, {0, 1, 0}}, Prefixes::none},
    {"min", {0, 60.0, {0, 0, 1}}, Prefixes::none},
    {"h", {0, 3600.0, {0, 0, 1}}, Prefixes::none},
    {"rad", {0, 1.0, {}}, Prefixes::allowed},
    {"deg", {0, std::numbers::pi / 180.0, {}}, Prefixes::none},
    {"\u00b0", {0, std::numbers::pi / 180.0, {}}, Prefixes::none},
    {"%", {-2, 1.0, {}}, Prefixes::none},
};

struct Prefix {
  std::string_view name;
  int exponent;
};

constexpr Prefix prefixes[] = {{"T", 12}, {"G", 9},  {"M", 6},       {"k", 3},       {"h", 2},  {"da", 1}, {"d", -1},
                               {"c", -2}, {"m", -3}, {"\u00b5", -6}, {"\u03bc", -6}, {"u", -6}, {"n", -9}, {"p", -12}};

std::optional<Unit> find_unit(std::string_view name) {
  for (const NamedUnit& u : units)
    if (u.name == name) return u.unit;
  for (const Prefix& prefix : prefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const NamedUnit& u : units) {
      if (u.prefixes == Prefixes::none || u.name != name.substr(prefix.name.size())) continue;
      Unit scaled = u.unit;
      scaled.exponent += prefix.exponent;
      return scaled;
    }
  }
  return std::nullopt;
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Do the words agree but for capitals? The number of letters that differ, if they do.
std::optional<int> wrong_capitals(std::string_view a, std::string_view b) {
  const auto same_letter = [](char p, char q) { return lower(p) == lower(q); };
  if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), same_letter)) return std::nullopt;
  return static_cast<int>(std::inner_product(a.begin(), a.end(), b.begin(), 0, std::plus<>(), std::not_equal_to<>()));
}

/// " (did you mean "MPa"?)" for units whose capitals are wrong, the one with the fewest wrong letters; or nothing.
std::string did_you_mean_unit(std::string_view name) {
  std::string best;
  int fewest = static_cast<int>(name.size()) + 1;
  const auto consider = [&](const std::string& unit) {
    const auto wrong = wrong_capitals(name, unit);
    if (!wrong || *wrong >= fewest) return;
    best = unit;
    fewest = *wrong;
  };
  for (const NamedUnit& u : units) {
    consider(std::string(u.name));
    if (u.prefixes == Prefixes::none) continue;
    for (const Prefix& prefix : prefixes) consider(fmt::format("{}{}", prefix.name, u.name));
  }
  return best.empty() ? std::string() : fmt::format(" (did you mean {}?)", quoted(best));
}

Unit power(const Unit& u, int n) {
  return {n * u.exponent, std::pow(u.factor, n), {n * u.dimension.length, n * u.dimension.mass, n * u.dimension.time}};
}

Unit product(const Unit& a, const Unit& b) {
  return {a.exponent + b.exponent,
          a.factor * b.factor,
          {a.dimension.length + b.dimension.length, a.dimension.mass + b.dimension.mass,
           a.dimension.time + b.dimension.time}};
}

struct Fault {
  std::size_t position;
  std::string what;
};

/// Reads `unit {(blank | * | . | /) unit}` with `unit = 1 | name [power] | ( ... ) [power]`.
class UnitReader {
 public:
  UnitReader(std::string_view text, std::size_t position) : text_(text), at_(position) {}

  Unit read() {
    const Unit u = read_product();
    if (at_ < text_.size()) fail(fmt::format("unexpected {} in the unit", quoted(text_.substr(at_))));
    return u;
  }

 private:
  Unit read_product() {
    skip_blanks();
    Unit result;
    if (!next_is("/")) result = read_power();
    while (true) {
      skip_blanks();
      if (at_ >= text_.size() || next_is(")")) return result;
      const bool divide = next_is("/");
      for (const std::string_view sign : {"/", "*", ".", "\u00b7"}) {
        if (!next_is(sign)) continue;
        at_ += sign.size();
        break;
      }
      skip_blanks();
      result = product(result, power(read_power(), divide ? -1 : 1));
    }
  }

  Unit read_power() {
    Unit u;
    if (next_is("(")) {
      ++at_;
      u = read_product();
      if (!next_is(")")) fail("a closing parenthesis is missing in the unit");
      ++at_;
    } else if (next_is("1") && !(at_ + 1 < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_ + 1])))) {
      ++at_;
    } else {
      u = read_name();
    }
    return power(u, read_exponent());
  }

  Unit read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter(at_)) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    at_ = begin;
    if (name.empty())
      fail(at_ < text_.size() ? fmt::format("unexpected {} in the unit", quoted(text_.substr(at_)))
                              : std::string("the unit ends too early"));
    const auto u = find_unit(name);
    if (!u)
      fail(
          fmt::format("unknown unit {}{}; known are m g s N Pa J W Hz bar t min h rad deg % with SI prefixes, as in "
                      "\"MPa\" or \"kg/m3\"",
                      quoted(name), did_you_mean_unit(name)));
    at_ = begin + name.size();
    return *u;
  }

  int read_exponent() {
    for (const auto& [sign, value] : {std::pair<std::string_view, int>{"\u00b2", 2}, {"\u00b3", 3}}) {
      if (!next_is(sign)) continue;
      at_ += sign.size();
      return value;
    }
    const bool marked = next_is("^");
    if (marked) ++at_;
    int value = 1;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    const bool found = error == std::errc() && std::abs(value) <= 9;
    if (!found && (marked || error != std::errc::invalid_argument))
      fail("a power from -9 to 9 is expected in the unit");
    if (found) at_ = static_cast<std::size_t>(end - text_.data());
    return found ? value : 1;
  }

  // Bytes of superscripts and of the middle dot end a name; other bytes beyond ASCII (the micro sign) belong to it.
  bool is_letter(std::size_t i) const {
    const auto c = static_cast<unsigned char>(text_[i]);
    if (c == '%' || std::isalpha(c) != 0) return true;
    if (c < 0x80) return false;
    const std::string_view rest = text_.substr(i);
    return !rest.starts_with("\u00b2") && !rest.starts_with("\u00b3") && !rest.starts_with("\u00b7");
  }

  bool next_is(std::string_view what) const { return text_.substr(at_).starts_with(what); }
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  [[noreturn]] void fail(const std::string& what) const { throw Fault{at_, what}; }

  std::string_view text_;
  std::size_t at_;
};

/// The length of the decimal number at the start of `text`, zero when there is none.
std::size_t number_length(std::string_view text) {
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  std::size_t digits = 0;
  std::size_t i = sign;
  for (; i < text.size() && (std::isdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == '.'); ++i)
    digits += text[i] == '.' ? 0 : 1;
  if (digits == 0 || std::count(text.begin(), text.begin() + i, '.') > 1) return 0;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t j = i + 1;
    if (j < text.size() && (text[j] == '+' || text[j] == '-')) ++j;
    const std::size_t first = j;
    while (j < text.size() && std::isdigit(static_cast<unsigned char>(text[j])) != 0) ++j;
    if (j > first) i = j;
  }
  return i;
}

/// The number `digits` times 10^exponent, rounded once.
double scaled(std::string_view digits, int exponent) {
  const auto e = digits.find_first_of("eE");
  int own = 0;
  if (e != std::string_view::npos) {
    std::string_view text = digits.substr(e + 1);
    if (text.starts_with("+")) text.remove_prefix(1);
    // Beyond these the number is zero or infinite anyway, and sums of exponents cannot overflow.
    constexpr int limit = 100000;
    if (std::from_chars(text.data(), text.data() + text.size(), own).ec != std::errc())
      own = text.starts_with("-") ? -limit : limit;
    own = std::clamp(own, -limit, limit);
  }
  std::string_view mantissa = digits.substr(0, e);
  if (mantissa.starts_with("+")) mantissa.remove_prefix(1);
  const std::string all = fmt::format("{}e{}", mantissa, own + exponent);
  double value = 0.0;
  const auto result = std::from_chars(all.data(), all.data() + all.size(), value);
  // Out of range leaves no value here, but zero or infinity there.
  return result.ec == std::errc() ? value : std::strtod(all.c_str(), nullptr);
}

struct NamedDimension {
  Dimension dimension;
  const char* name;
  const char* unit;
  const char* examples;
};

constexpr NamedDimension named[] = {
    {dimension::none, "number", "", "0.25"},
    {dimension::length, "length", "m", "\"10 mm\" or 0.01"},
    {dimension::time, "time", "s", "\"5 ms\" or 0.005"},
    {dimension::rate, "rate", "1/s", "\"10 1/s\" or 10"},
    {dimension::velocity, "velocity", "m/s", "\"0.1 mm/s\" or 1e-4"},
    {dimension::acceleration, "acceleration", "m/s2", "\"9.81 m/s2\" or 9.81"},
    {dimension::density, "density", "kg/m3", "\"1000 kg/m3\" or 1000"},
    {dimension::pressure, "pressure", "Pa", "\"17 MPa\" or 17e6"},
    {{0, 1, 0}, "mass", "kg", "\"2 kg\" or 2"},
    {{1, 1, -2}, "force", "N", "\"5 kN\" or 5000"},
    {{2, 1, -2}, "energy", "J", "\"3 J\" or 3"},
    {{2, 0, 0}, "area", "m2", "\"4 mm2\" or 4e-6"},
    {{3, 0, 0}, "volume", "m3", "\"8 mm3\" or 8e-9"},
};

const NamedDimension* find_named(const Dimension& d) {
  const auto* found =
      std::find_if(std::begin(named), std::end(named), [&](const NamedDimension& n) { return n.dimension == d; });
  return found == std::end(named) ? nullptr : found;
}

}  // namespace

DimensionalResult read_quantity(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {std::nullopt, 0, "it is empty"};
  const std::string_view body = text.substr(0, text.find_last_not_of(' ') + 1);
  const std::size_t length = number_length(body.substr(begin));
  if (length == 0) return {std::nullopt, begin, "a number is expected at the start"};
  const std::string_view digits = body.substr(begin, length);
  try {
    Unit unit;
    if (begin + length < body.size()) unit = UnitReader(body, begin + length).read();
    const double value = scaled(digits, unit.exponent) * unit.factor;
    if (!std::isfinite(value)) return {std::nullopt, begin, "the number is too large"};
    return {DimensionalValue{value, unit.dimension}, 0, {}};
  } catch (const Fault& fault) {
    return {std::nullopt, fault.position, fault.what};
  }
}

bool is_unit(std::string_view name) { return find_unit(name).has_value(); }

bool looks_like_quantity(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return false;
  const std::size_t length = number_length(text.substr(begin));
  if (length == 0) return false;
  const std::string_view rest = text.substr(begin + length);
  const std::string_view unit = trimmed(rest);
  if (unit.empty()) return false;
  const auto first = static_cast<unsigned char>(unit[0]);
  return std::isalpha(first) != 0 || first == '%' || first >= 0x80 || (rest[0] == ' ' && unit.starts_with("1/"));
}

std::string name_of(const Dimension& d) {
  const NamedDimension* found = find_named(d);
  return found != nullptr ? found->name : "quantity";
}

std::string si_unit(const Dimension& d) {
  if (const NamedDimension* found = find_named(d)) return found->unit;
  std::vector<std::string> parts;
  for (const auto& [symbol, n] : {std::pair{"m", d.length}, {"kg", d.mass}, {"s", d.time}})
    if (n != 0) parts.push_back(n == 1 ? symbol : fmt::format("{}{}", symbol, n));
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string examples_of(const Dimension& d) {
  const NamedDimension* found = find_named(d);
  return found != nullptr ? found->examples : fmt::format("\"1 {}\"", si_unit(d));
}

}  // namespace tessera
