#include "tessera/base/unit_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <numbers>
#include <numeric>

#include "tessera/base/text.hpp"

namespace tessera {

namespace {

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

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Do the words agree but for capitals? The number of letters that differ, if they do.
std::optional<int> wrong_capitals(std::string_view a, std::string_view b) {
  const auto same_letter = [](char p, char q) { return lower(p) == lower(q); };
  if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), same_letter)) return std::nullopt;
  return static_cast<int>(std::inner_product(a.begin(), a.end(), b.begin(), 0, std::plus<>(), std::not_equal_to<>()));
}

}  // namespace

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

}  // namespace tessera
