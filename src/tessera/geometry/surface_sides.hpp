#pragma once

#include <span>
#include <string>
#include <vector>

#include "tessera/geometry/selection.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// Replaces the sides by the patches that sharp edges part: triangles are on one side when a way leads from one to the
/// other over edges where the normal turns by at most `split_angle` [degrees, above 0, below 180]. The sides are called
/// "side1", "side2", ... by falling area, of equal areas by the centre's x, then y, then z; so the names do not depend
/// on the order of triangles or vertices. Edges of more than two triangles always part sides.
void split_sides_at_edges(TriangleSurface& surface, double split_angle);

/// A side that the user names.
struct NamedSide {
  std::string name;
  SelectionSpec where;
};

/// Puts the triangles whose centre (or present side's name) a selection takes on the side of that name; the others stay
/// where they are, and sides that nothing is left of vanish. Throws InputError at the selection's origin when it takes
/// nothing, or a triangle that an earlier one has taken.
void name_sides(TriangleSurface& surface, std::span<const NamedSide> sides);

/// A line of the table of sides.
struct SideSummary {
  std::string name;
  Index triangles = 0;
  double area = 0.0;  // [m2]
  Vec3 normal;        // of length one and the direction of the area vectors' sum; zero when that vanishes (a sphere)
  Vec3 center;        // of area [m]
  Bounds box;         // around it [m]
};

/// One line per side, in their order.
std::vector<SideSummary> summarize_sides(const TriangleSurface& surface);

/// Removes sides that have no triangle.
void remove_unused_sides(TriangleSurface& surface);

}  // namespace tessera
