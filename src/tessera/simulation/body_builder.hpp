#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/discretization/discretization.hpp"
#include "tessera/discretization/identities.hpp"
#include "tessera/loads/assignment.hpp"
#include "tessera/loads/surface.hpp"
#include "tessera/output/fields.hpp"
#include "tessera/simulation/case.hpp"
#include "tessera/simulation/side_table.hpp"

namespace tessera {

/// One body on its own; everything counts from its first particle.
struct BuiltBody {
  Discretization d;
  Surface surface;
  std::vector<Index> user_number;
  std::vector<PointConstraint> constraints;  // per boundary node (voronoi) or constrained particle (delaunay)
  std::vector<LoadedPiece> loaded;
  std::vector<PointConstraint> pieces;  // what is prescribed on each piece; nothing for delaunay, which holds particles
  Index sites_per_piece = 1;            // load sites: a Voronoi face is one, a triangle three (its vertices)
  Identities identities;
  std::optional<Solid> solid;
  std::optional<TriangleSurface> outline;  // of bodies that are no `solid`
  std::vector<SideRow> sides;
  std::optional<CellGeometry> cells;
  std::vector<std::string> notes;  // lines for the user about what was built
};

/// Conditions that apply to one body.
using ConditionList = std::vector<const BoundaryCondition*>;

/// Conditions that a case sets on one body. In two dimensions the slab's faces are symmetric.
std::vector<BoundaryCondition> conditions_on(const Case& c, const BodySpec& body);

/// Builds one body: points, cells, constraints, bonds. `conditions` must outlive the result. Geometry errors say which
/// body it is.
BuiltBody build_body(const Case& c, const BodySpec& body, const std::vector<BoundaryCondition>& conditions);

}  // namespace tessera
