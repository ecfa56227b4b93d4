#pragma once

#include <string>
#include <vector>

#include "tessera/geometry/surface_sides.hpp"
#include "tessera/loads/surface.hpp"

namespace tessera {

/// A side of a body, for a user who looks for its name.
struct SideRow {
  std::string body;
  std::vector<std::string> names;  // all that `where` may call it
  SideSummary side;
  Index faces = 0;  // of cells or tetrahedra that lie on it
};

/// `sides` are those of the surface, in their order.
std::vector<SideRow> side_rows(const Surface& surface, const std::vector<SideSummary>& sides);

/// A table for a terminal.
std::string to_text(const std::vector<SideRow>& rows);

}  // namespace tessera
