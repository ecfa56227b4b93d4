#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/discretization/identities.hpp"
#include "tessera/loads/loads.hpp"
#include "tessera/loads/surface.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/output/fields.hpp"
#include "tessera/output/quality.hpp"
#include "tessera/output/summary.hpp"
#include "tessera/simulation/case.hpp"
#include "tessera/simulation/side_table.hpp"

namespace tessera {

/// Where a body's particles are, and its boundary for selections.
struct BodyModel {
  std::string name;
  Index first = 0, last = 0;      // particles [first, last)
  Surface surface;                // pieces' vertices count from the body's first particle
  std::vector<Index> node_piece;  // piece of each boundary node of this body (voronoi)
  Index first_node = 0;
  Index first_constraint = 0, last_constraint = 0;  // of its constrained particles (delaunay)
};

/// A case built: particles, cells and bonds, loads, initial state.
struct Model {
  System system;
  std::vector<std::vector<BoundaryCondition>> conditions;  // of each body; the loads point at them
  Loads loads;
  std::vector<BodyModel> bodies;
  std::vector<Index> user_number;  // of each particle: its place in the order in which the user knows the particles
  std::vector<Index> body_of, material_of;
  std::vector<Vec3> initial_displacement, initial_velocity;  // [m], [m/s]
  Identities identities;
  Quality quality;
  Index boundary_faces = 0;
  std::vector<SideRow> sides;         // of all bodies
  std::vector<std::string> notes;     // lines for the user about what was built
  std::optional<CellGeometry> cells;  // for pictures, when the case asks for them; particles by user number

  /// The body of that name; an empty name means the only body.
  const BodyModel& body(const std::string& name) const;
};

/// Builds a case. Throws InputError and GeometryError.
Model build_model(const Case& c);

/// The integration that the model has, and where it is another.
IntegrationSummary integration_of(const Model& model);

}  // namespace tessera
