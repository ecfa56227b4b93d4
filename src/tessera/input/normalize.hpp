#pragma once

#include <string>
#include <vector>

#include "tessera/input/value.hpp"

namespace tessera::input {

/// A case in its one form: every key known, converted and in the order of the table, all defaults filled in.
struct NormalCase {
  Value root;
  std::vector<std::string> unused;  // one line about each key that was given where it has no effect
};

/// Checks a case against the input table. `directory` is that of the case file. Throws InputError for unknown keys,
/// wrong types, units and ranges, missing keys and alternatives given together.
NormalCase normalize(const Value& root, const std::string& directory);

}  // namespace tessera::input
