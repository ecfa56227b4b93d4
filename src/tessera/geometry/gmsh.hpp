#pragma once

#include <string>
#include <string_view>

#include "tessera/geometry/mesh_file.hpp"

namespace tessera {

/// Reads the bytes of a Gmsh file, format 2.2 or 4.1, ASCII or binary (little-endian). Linear tetrahedra and
/// triangles are taken; points and lines are passed over; everything else is refused. `path` is for
/// errors only.
FileMesh read_gmsh(const std::string& path, std::string_view bytes);

}  // namespace tessera
