#pragma once

#include <string>
#include <string_view>

#include "tessera/geometry/mesh_file.hpp"

namespace tessera {

/// Reads the bytes of a VTK XML unstructured grid in one piece: arrays as text, base64 or appended (base64 or raw),
/// each plain or compressed by zlib. Tetrahedra are taken; vertices, lines and triangles passed over; other cells
/// refused. Points and cells are numbered from 0, as VTK does. `path` is for errors only.
FileMesh read_vtu(const std::string& path, std::string_view bytes);

}  // namespace tessera
