#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_edges.hpp"
#include "tessera/geometry/surface_index.hpp"

namespace tessera {
namespace {

/// Per shell a point of its that is on no other shell: a vertex, or where others touch in all of them, the centre of a
/// triangle.
std::vector<Vec3> own_points(const TriangleSurface& surface, const Shells& shells) {
  constexpr Index nobody = -1, several = -2;
  std::vector<Index> owner(surface.vertices.size(), nobody);
  for (Index t = 0; t < surface.size(); ++t)
    for (const Index v : surface.triangle(t)) {
      Index& o = owner[static_cast<std::size_t>(v)];
      const Index shell = shells.of[static_cast<std::size_t>(t)];
      o = o == nobody || o == shell ? shell : several;
    }
  std::vector<Vec3> points(shells.volume.size());
  for (Index t = surface.size() - 1; t >= 0; --t) {
    const auto [a, b, c] = surface.corners(t);
    points[static_cast<std::size_t>(shells.of[static_cast<std::size_t>(t)])] = (a + b + c) / 3.0;
  }
  for (std::size_t v = 0; v < owner.size(); ++v)
    if (owner[v] >= 0) points[static_cast<std::size_t>(owner[v])] = surface.vertices[v];
  return points;
}

[[noreturn]] void refuse_shell(const FileSurface& file, const Vec3& at, double volume, int around) {
  const std::string shell =
      fmt::format("{}: the closed surface at {}, volume {:.4g},", file.path, describe_point(at), std::abs(volume));
  if (volume < 0 && around <= 0)
    throw GeometryError(shell +
                        " is inside out, its triangles run clockwise seen from outside: turn its faces round (flip "
                        "the normals) in the program that wrote it");
  if (volume > 0)
    throw GeometryError(shell +
                        " lies within another and is turned outwards as that is: for a cavity turn its faces round "
                        "(flip the normals), for a solid without one remove it");
  throw GeometryError(
      fmt::format("{} bounds a cavity, but lies within {} others: remove what overlaps", shell, around));
}

}  // namespace

Shells find_shells(const TriangleSurface& surface) {
  ParitySets sets(surface.size());
  for_each_edge(edge_uses(surface), [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) sets.join(uses[0].triangle, use.triangle, false);
  });
  Shells shells;
  std::vector<Vec3> origin;
  std::vector<Index> number(surface.triangles.size(), -1);  // per root
  for (Index t = 0; t < surface.size(); ++t) {
    Index& shell = number[static_cast<std::size_t>(sets.find(t).root)];
    const auto [a, b, c] = surface.corners(t);
    if (shell < 0) {
      shell = static_cast<Index>(shells.volume.size());
      shells.volume.push_back(0.0);
      origin.push_back(a);
    }
    shells.of.push_back(shell);
    const Vec3& o = origin[static_cast<std::size_t>(shell)];
    shells.volume[static_cast<std::size_t>(shell)] += dot(a - o, cross(b - o, c - o)) / 6.0;
  }
  return shells;
}

void refuse_wrong_nesting(const FileSurface& file, const Shells& shells) {
  const SurfaceIndex index(file.surface);
  const std::vector<Vec3> points = own_points(file.surface, shells);
  for (std::size_t s = 0; s < points.size(); ++s) {
    const int around = index.winding_of(
        points[s], [&](Index t) { return shells.of[static_cast<std::size_t>(t)] != static_cast<Index>(s); });
    const double volume = shells.volume[s];
    if (around != (volume > 0 ? 0 : 1)) refuse_shell(file, points[s], volume, around);
  }
}

}  // namespace tessera
