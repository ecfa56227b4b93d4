#pragma once

#include <string>

namespace tessera {

/// The version of the program, as in "0.1.0".
std::string version();

}  // namespace tessera
