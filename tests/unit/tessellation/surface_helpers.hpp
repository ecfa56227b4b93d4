#pragma once

#include <random>

#include "support/triangle_surfaces.hpp"
#include "tessera/geometry/surface_index.hpp"
#include "tessera/tessellation/surface_cells.hpp"
#include "voronoi_helpers.hpp"

namespace tessera::test {

/// Points of a lattice around the origin, each moved by up to `jitter` spacings, that lie inside the surface and at
/// least `away` spacings from it.
inline std::vector<Vec3> lattice_in(const SurfaceIndex& index, double spacing, double jitter, std::uint32_t seed,
                                    double away = 0.1, const Vec3& offset = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  const Bounds box = bounds(index.surface());
  const auto first = [&](int d) { return static_cast<int>(std::floor(box.lower[d] / spacing)) - 1; };
  const auto last = [&](int d) { return static_cast<int>(std::ceil(box.upper[d] / spacing)) + 1; };
  std::vector<Vec3> points;
  for (int k = first(2); k <= last(2); ++k)
    for (int j = first(1); j <= last(1); ++j)
      for (int i = first(0); i <= last(0); ++i) {
        const Vec3 X =
            spacing * (Vec3{i + 0.5 + move(random), j + 0.5 + move(random), k + 0.5 + move(random)} + offset);
        if (index.location(X) == Location::inside && index.nearest(X).distance >= away * spacing) points.push_back(X);
      }
  return points;
}

/// Every cell is closed, keeps the first moment, and all together fill the solid.
inline void expect_exact(const SurfaceCells& made, const std::vector<Vec3>& points, const TriangleSurface& surface,
                         const std::string& what, double tolerance = 1e-12) {
  Solid solid;
  solid.volume = volume(surface);
  const Residuals r = residuals(made.cells, points, solid);
  EXPECT_LE(r.closure, tolerance) << what;
  EXPECT_LE(r.volume, tolerance) << what;
  EXPECT_LE(r.first_moment, tolerance) << what;
  EXPECT_LE(r.total, tolerance) << what;
}

}  // namespace tessera::test
