#pragma once

#include <string>

#include "tessera/input/parameter.hpp"
#include "tessera/input/value.hpp"

namespace tessera::input {

/// What conversion depends on apart from the row and the value.
struct Setting {
  int dimension = 3;      // 2: vectors may have two components
  std::string directory;  // of the case file; relative file names start there
};

/// Checks a value against its row and brings it into the one form that the rest of the program reads: numbers in SI
/// units, formulas as numbers or strings, vectors with three components, lists where one string was allowed, absolute
/// file names. Throws InputError at the value's place. Tables and shapes are not its business.
Value convert(const Parameter& parameter, const Value& value, const Setting& setting);

}  // namespace tessera::input
