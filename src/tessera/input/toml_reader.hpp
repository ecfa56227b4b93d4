#pragma once

#include <optional>
#include <string>

#include "tessera/input/value.hpp"

namespace tessera::input {

/// Reads TOML text; `file` is the name that messages show. Throws InputError at the place of a syntax error.
Value read_toml(const std::string& text, const std::string& file);

/// Reads one TOML value, such as `0.1`, `"5 ms"` or `[1, 2]`; nothing when the text is not exactly one value.
std::optional<Value> read_toml_value(const std::string& text);

}  // namespace tessera::input
