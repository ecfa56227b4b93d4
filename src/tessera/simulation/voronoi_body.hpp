#pragma once

#include "tessera/simulation/body_builder.hpp"

namespace tessera {

/// A body of Voronoi cells in disjoint convex pieces.
BuiltBody build_voronoi(const Case& c, const BodySpec& body, const Solid& solid, const ConditionList& conditions);
/// The same in any other shape: within the closed surface that it has.
BuiltBody build_voronoi_in_surface(const Case& c, const BodySpec& body, const ConditionList& conditions);

}  // namespace tessera
