#pragma once

#include <cstdint>
#include <string>

#include "tessera/base/error.hpp"

namespace tessera {

/// How a place in a file is counted, from one.
enum class PlaceUnit { line, byte };

/// "path:12: " or "path: byte 345: ".
std::string locate(const std::string& path, PlaceUnit unit, std::int64_t place);

/// The whole file. Throws GeometryError when it cannot be read or is empty.
std::string read_whole_file(const std::string& path);

/// Throws GeometryError with the place in the case file where a file is named that is not there.
void require_file(const std::string& path, const Origin& origin);

}  // namespace tessera
