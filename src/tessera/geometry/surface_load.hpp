#pragma once

#include <string>

#include "tessera/geometry/surface_check.hpp"

namespace tessera {

/// Reads a surface file (surface_reader.hpp), mends and checks it (surface_check.hpp) and gives it in metres; `unit` is
/// the length of the file's unit [m]. The repairs' tolerance is in metres, too; places in errors are in the file's
/// unit.
CheckedSurface load_surface(const std::string& path, double unit);

/// What was read and mended, in one line: "12 triangles, 8 vertices, 1 shell; 3 vertices welded, ...".
std::string describe(const CheckedSurface& checked);

}  // namespace tessera
