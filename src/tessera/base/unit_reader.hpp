#pragma once

#include <string>
#include <string_view>

#include "tessera/base/unit_names.hpp"

namespace tessera {

/// Why a text is no unit, and where.
struct UnitFault {
  std::size_t position;
  std::string what;
};

/// Reads the unit that `text` holds from `position` to its end; throws UnitFault when it is none.
Unit read_unit(std::string_view text, std::size_t position);

}  // namespace tessera
