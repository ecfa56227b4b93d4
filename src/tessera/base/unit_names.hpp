#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tessera/base/units.hpp"

namespace tessera {

/// A unit as 10^exponent times factor times base units; exact powers of ten stay apart so that they can be applied to
/// the decimal digits of a number.
struct Unit {
  int exponent = 0;
  double factor = 1.0;
  Dimension dimension;
};

/// The unit of that name, with or without an SI prefix ("mm", "MPa").
std::optional<Unit> find_unit(std::string_view name);

/// " (did you mean "MPa"?)" for units whose capitals are wrong, the one with the fewest wrong letters; or nothing.
std::string did_you_mean_unit(std::string_view name);

}  // namespace tessera
