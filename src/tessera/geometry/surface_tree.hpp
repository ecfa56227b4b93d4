#pragma once

#include <string>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/geometry/bounds.hpp"
#include "tessera/geometry/shape_move.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

enum class Boolean { unite, subtract, intersect };

/// A solid as closed surfaces and what is done with them. The numbers of sides of all leaves count in one list.
struct SurfaceTree {
  Origin origin;
  std::string path;                // how its sides are called: "hole", "part2", "part2.part1"; empty at the root
  TriangleSurface surface;         // of a leaf
  std::vector<Index> sides;        // of all leaves below, ascending
  Boolean boolean{};               // of parts: the first one with all others
  std::vector<SurfaceTree> parts;  // none for a leaf
  AffineMap map;                   // what then moves it
  Bounds box;                      // found by `evaluate`, around the moved result, in the root's frame

  bool is_leaf() const { return parts.empty(); }
};

/// The surface of the tree's solid, computed without round-off but that of the result's coordinates and not yet
/// checked; its side_names are empty. Throws InputError at a tree's origin when it leaves nothing, when the parts touch
/// in a way that bounds no solid, and for every boolean when the program is built without TESSERA_WITH_CGAL.
TriangleSurface evaluate(SurfaceTree& tree);

}  // namespace tessera
