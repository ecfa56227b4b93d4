#pragma once

#include <string>
#include <vector>

#include "tessera/input/value.hpp"

namespace tessera::input {

/// Applies "key=value" texts, such as "time.end=0.1" or "body.0.particles.jitter=0.1", to a case. A value that is no
/// TOML is taken as a string. Throws InputError (origin "command line") when a text has no key, or its path does not
/// fit.
void apply_overrides(Value& root, const std::vector<std::string>& overrides);

}  // namespace tessera::input
