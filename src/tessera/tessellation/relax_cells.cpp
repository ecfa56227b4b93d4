#include "tessera/tessellation/relax_cells.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/geometry/boundary.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/parallel/workspaces.hpp"
#include "tessera/tessellation/surface_cutter.hpp"
#include "tessera/tessellation/surface_fence.hpp"

namespace tessera {
namespace {

constexpr double kFenceDistance = 2.0;  // from the surface, in spacings

double radius_around(std::span<const ConvexPolyhedron> parts, const Vec3& X) {
  double largest2 = 0.0;
  for (const ConvexPolyhedron& part : parts)
    for (const Vec3& vertex : part.vertices) largest2 = std::max(largest2, norm2(vertex - X));
  return std::sqrt(largest2);
}

}  // namespace

CellCentroid centroid_of(std::span<const ConvexPolyhedron> parts, const Vec3& base) {
  double six_volumes = 0.0;
  Vec3 moment;
  for (const ConvexPolyhedron& part : parts)
    for (Index f = 0; f < part.faces(); ++f) {
      const std::span<const Index> face = part.face(f);
      const auto vertex = [&](std::size_t i) { return part.vertices[static_cast<std::size_t>(face[i])] - base; };
      const Vec3 p = vertex(0);
      Vec3 q = vertex(1);
      for (std::size_t i = 2; i < face.size(); ++i) {
        const Vec3 r = vertex(i);
        const double volume = dot(p, cross(q, r));
        six_volumes += volume;
        moment += volume * (p + q + r);
        q = r;
      }
    }
  return {six_volumes / 6.0, base + moment / (4.0 * six_volumes)};
}

CentroidsInSolid::CentroidsInSolid(const Solid& solid) : solid_(solid) {
  const Vec3 size = solid.upper - solid.lower;
  tolerance_ = 1e-9 * std::max({size.x, size.y, size.z});
}

bool CentroidsInSolid::contains(const Vec3& X) const { return is_well_inside(solid_, X, tolerance_); }

void CentroidsInSolid::find(std::span<const Vec3> points, std::vector<CellCentroid>& centroids) const {
  const PointGrid grid = VoronoiCutter::grid_of(points, solid_);
  parallel::Workspaces<VoronoiCutter> cutters([&] { return std::make_unique<VoronoiCutter>(points, solid_, grid); });
  centroids.resize(points.size());
  parallel::for_ranges(0, static_cast<std::int64_t>(points.size()), [&](std::int64_t begin, std::int64_t end) {
    const parallel::Workspaces<VoronoiCutter>::Lease cutter(cutters);
    for (auto a = static_cast<std::size_t>(begin); a < static_cast<std::size_t>(end); ++a)
      centroids[a] = centroid_of(cutter->cut(static_cast<Index>(a)), points[a]);
  });
}

CentroidsInSurface::CentroidsInSurface(const SurfaceIndex& index, std::size_t points)
    : index_(index), planes_(find_planes(index.surface())) {
  spacing_ = std::cbrt(volume(index.surface()) / static_cast<double>(points));
  fence_ = fence_points(index.surface(), kFenceDistance * spacing_);
  Bounds box;
  for (const Vec3& X : fence_) box.include(X);
  around_ = build_solid(Shape{"", {}, BoxShape{box.lower, box.upper}});
}

/// A cell within the fence that does not reach to the surface is a cell in the solid.
void CentroidsInSurface::find(std::span<const Vec3> points, std::vector<CellCentroid>& centroids) const {
  const std::vector<Vec3> generators = enclosed_generators(points, fence_);
  const PointGrid grid = grid_of(generators, spacing_);
  const std::span<const Vec3> near(generators.data(), points.size() + fence_.size());
  struct Tools {
    VoronoiCutter whole;
    DualCellCutter cells;
    SurfaceCutter surface;
  };
  parallel::Workspaces<Tools> tools([&] {
    return std::make_unique<Tools>(Tools{VoronoiCutter(near, around_, grid), DualCellCutter(generators, grid),
                                         SurfaceCutter(generators, index_, planes_)});
  });
  centroids.resize(points.size());
  parallel::for_ranges(0, static_cast<std::int64_t>(points.size()), [&](std::int64_t begin, std::int64_t end) {
    const parallel::Workspaces<Tools>::Lease own(tools);
    for (auto a = static_cast<std::size_t>(begin); a < static_cast<std::size_t>(end); ++a) {
      const Vec3& X = points[a];
      const auto parts = own->whole.cut(static_cast<Index>(a));
      if (!index_.is_nearer_than(radius_around(parts, X), X)) {
        centroids[a] = centroid_of(parts, X);
        continue;
      }
      const CutCell& cell = own->surface.cut(own->cells.cut(static_cast<Index>(a)));
      const CutCell::Part& home = cell.parts[static_cast<std::size_t>(cell.home)];
      centroids[a] = {home.volume, X + home.moment / home.volume};
    }
  });
}

}  // namespace tessera
