#pragma once

#include <string>

namespace tessera {

/// Version, compiler, build type, options and the papers to cite, as several lines.
std::string version_text();

}  // namespace tessera
