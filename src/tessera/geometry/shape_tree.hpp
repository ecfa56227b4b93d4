#pragma once

#include <string>
#include <vector>

#include "tessera/geometry/shape.hpp"
#include "tessera/geometry/surface_tree.hpp"

namespace tessera {

/// The surfaces of a shape's parts, each in its own place, and what is to be done with them.
struct ShapeTree {
  SurfaceTree root;
  std::vector<std::string> side_names;  // of all leaves, each once
  std::vector<std::string> notes;       // lines for the user about files
};

/// Reads, facets and names the surfaces of all parts of a shape. Errors as of shape_surface.
ShapeTree tree_of(const Shape& shape);

}  // namespace tessera
