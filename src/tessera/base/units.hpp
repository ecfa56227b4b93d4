#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tessera {

/// Powers of the base units metre, kilogram and second. Angles and percentages have none.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;

  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{1, 0, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension rate{0, 0, -1};
inline constexpr Dimension velocity{1, 0, -1};
inline constexpr Dimension acceleration{1, 0, -2};
inline constexpr Dimension density{-3, 1, 0};
inline constexpr Dimension pressure{-1, 1, -2};
}  // namespace dimension

/// A number in SI units together with its dimension.
struct DimensionalValue {
  double value = 0.0;
  Dimension dimension;
};

/// What reading a quantity gave: the quantity, or why the text is none.
struct DimensionalResult {
  std::optional<DimensionalValue> quantity;
  std::size_t position = 0;  // of the fault in the text, from zero
  std::string fault;
};

/// Reads "17 MPa", "0.1 mm/s", "1000 kg/m3", "9.81 m s^-2", "10 1/s", "30 deg" or "5": a number and a product, quotient
/// or power of units with SI prefixes. A decimal number is scaled in decimal, so "0.1 mm" is the same number as 1e-4.
DimensionalResult read_quantity(std::string_view text);

/// Is `name` a unit, with or without an SI prefix ("mm", "MPa")?
bool is_unit(std::string_view name);

/// True for a number that is followed by a letter (or by 1/...), which is never a formula.
bool looks_like_quantity(std::string_view text);

/// "pressure", "length", ...; dimensions without a name of their own are called "quantity".
std::string name_of(const Dimension& d);

/// "Pa", "m", "kg/m3", ...; empty for pure numbers. Products are written like "m kg s-1".
std::string si_unit(const Dimension& d);

/// Two ways to write such a value, as in a case file: "\"10 mm\" or 0.01".
std::string examples_of(const Dimension& d);

}  // namespace tessera
