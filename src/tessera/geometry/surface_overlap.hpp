#pragma once

#include <optional>
#include <span>

#include "tessera/geometry/surface_index.hpp"

namespace tessera {

/// A solid that a closed surface bounds, and some points in it.
struct FilledSurface {
  const SurfaceIndex& index;
  std::span<const Vec3> points;  // [m]
};

/// A place that is in both solids, by more than `slack` [m] inside one of them: a corner, a piece of an edge, the
/// middle of a triangle or one of the points of the other. Solids that touch have none.
std::optional<Vec3> find_overlap(const FilledSurface& a, const FilledSurface& b, double slack);

}  // namespace tessera
