#pragma once

#include "tessera/simulation/body_builder.hpp"

namespace tessera {

/// A body of tetrahedra: in `solid`, or in a shape or from a file that has none.
BuiltBody build_delaunay(const Case& c, const BodySpec& body, const std::optional<Solid>& solid,
                         const ConditionList& conditions);

}  // namespace tessera
