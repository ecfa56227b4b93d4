#pragma once

#include "tessera/input/value.hpp"
#include "tessera/simulation/case.hpp"

namespace tessera::input {

/// Makes a case of a normalized tree (see normalize()), and checks what concerns several keys: names that must be known
/// or must not be doubled, and keys that need each other. `file` and `effective` stay empty.
Case build_case(const Table& root);

}  // namespace tessera::input
