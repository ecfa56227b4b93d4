#include "tessera/base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "tessera/base/text.hpp"
#include "tessera/base/unit_reader.hpp"

namespace tessera {

namespace {

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
    if (begin + length < body.size()) unit = read_unit(body, begin + length);
    const double value = scaled(digits, unit.exponent) * unit.factor;
    if (!std::isfinite(value)) return {std::nullopt, begin, "the number is too large"};
    return {DimensionalValue{value, unit.dimension}, 0, {}};
  } catch (const UnitFault& fault) {
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

}  // namespace tessera
