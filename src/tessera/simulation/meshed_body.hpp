#pragma once

#include <string>
#include <vector>

#include "tessera/simulation/case.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// The tetrahedra of a delaunay body whose shape is a surface, made by a mesher from the spacing (or the number) of its
/// particles; tells in `notes` how good they are. Throws InputError for particles that are asked for otherwise, and
/// GeometryError when the surface cannot be meshed or this build has no mesher.
TetrahedralMesh mesh_of_shape(const BodySpec& body, std::vector<std::string>& notes);

}  // namespace tessera
