#pragma once

#include <vector>

#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// A chain of edges by its vertices; a closed one ends with its first vertex.
using FeatureLine = std::vector<Index>;

/// What a mesh of a surface must keep.
struct SurfaceFeatures {
  std::vector<FeatureLine> lines;
  std::vector<Index> patch;  // per triangle: the part of the surface between the lines that it belongs to, from zero
};

/// The lines are edges where the normal turns by more than `angle` [degrees], where sides
/// meet, or that more than two triangles share. A line ends where other than two such edges meet and at its own
/// corners, where it turns by more than kCornerAngle.
SurfaceFeatures surface_features(const TriangleSurface& surface, double angle);

inline constexpr double kCornerAngle = 30.0;  // [degrees]

}  // namespace tessera
