#include "tessera/geometry/surface_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/geometry/predicates.hpp"
#include "tessera/geometry/surface_sides.hpp"

namespace tessera {
namespace {

void refuse_empty(const FileSurface& file) {
  if (file.surface.triangles.empty())
    throw GeometryError(
        fmt::format("{}: holds no triangle that has an area: a surface that bounds a solid is expected", file.path));
}

void refuse_flatness(const FileSurface& file, const SurfaceRepairs& repairs) {
  if (file.surface.triangles.empty())
    throw GeometryError(fmt::format(
        "{}: holds no triangle that has an area: {} are no thicker than {:.3g}, which single precision leaves "
        "undecided at the largest coordinate, all others lie on each other; a surface that bounds a solid is "
        "expected",
        file.path, repairs.flat_triangles, repairs.tolerance));
}

}  // namespace

void refuse_bad_vertices(const FileSurface& file) {
  for (Index t = 0; t < file.surface.size(); ++t)
    for (const Vec3& X : file.surface.corners(t))
      for (int d = 0; d < 3; ++d)
        if (!(std::abs(X[d]) < kLargestCoordinate))
          throw GeometryError(fmt::format("{}: {} has the coordinate {}; finite numbers below {:g} are allowed",
                                          file.path, describe_triangle(file, t), X[d], kLargestCoordinate));
}

CheckedSurface check_surface(FileSurface file) {
  const double tolerance = weld_tolerance(file.surface);
  return check_surface(std::move(file), tolerance);
}

CheckedSurface check_surface(FileSurface file, double tolerance) {
  refuse_empty(file);
  refuse_bad_vertices(file);
  SurfaceRepairs repairs;
  repairs.tolerance = tolerance;
  weld_vertices(file.surface, repairs);
  drop_needless_triangles(file, repairs);
  refuse_flatness(file, repairs);
  split_at_vertices_on_edges(file, repairs);
  weld_vertices(file.surface, repairs);
  refuse_holes(file);
  turn_contrary_triangles(file, repairs);
  refuse_contrary_edges(file);
  refuse_wrong_meetings(file);
  const Shells shells = find_shells(file.surface);
  refuse_wrong_nesting(file, shells);
  remove_unused_sides(file.surface);

  CheckedSurface checked{std::move(file.surface), repairs, 0, 0};
  for (const double v : shells.volume) ++(v > 0 ? checked.shells : checked.cavities);
  return checked;
}

}  // namespace tessera
