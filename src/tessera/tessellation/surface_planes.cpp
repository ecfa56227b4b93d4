#include "tessera/tessellation/surface_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tessera/base/csr.hpp"

namespace tessera {
namespace {

constexpr double kSameNormal = 1e-13;  // largest difference of unit normals
constexpr double kSameHeight = 1e-14;  // of the size of the surface

/// The triangles at every vertex.
Csr<Index> triangles_at_vertices(const TriangleSurface& surface) {
  struct Use {
    Index vertex, triangle;
  };
  std::vector<Use> uses;
  for (Index t = 0; t < surface.size(); ++t)
    for (const Index v : surface.triangle(t)) uses.push_back({v, t});
  const auto rows =
      group_by_row<Use>(static_cast<Index>(surface.vertices.size()), uses, [](const Use& use) { return use.vertex; });
  Csr<Index> triangles;
  triangles.offset = rows.offset;
  for (const Use& use : rows.value) triangles.value.push_back(use.triangle);
  return triangles;
}

class Patches {
 public:
  explicit Patches(const TriangleSurface& surface) : surface_(surface), around_(triangles_at_vertices(surface)) {
    const Vec3 size = bounds(surface).size();
    tolerance_ = kSameHeight * std::max({size.x, size.y, size.z});
  }

  SurfacePlanes find() {
    for (Index t = 0; t < surface_.size(); ++t) planes_.normal.push_back(normalized(area_vector(surface_, t)));
    planes_.patch.assign(planes_.normal.size(), -1);
    for (Index t = 0; t < surface_.size(); ++t)
      if (planes_.patch[static_cast<std::size_t>(t)] < 0) grow_from(t);
    return std::move(planes_);
  }

 private:
  void grow_from(Index seed) {
    const auto patch = static_cast<Index>(planes_.side.size());
    planes_.side.push_back(surface_.side[static_cast<std::size_t>(seed)]);
    planes_.outward.push_back(planes_.normal[static_cast<std::size_t>(seed)]);
    planes_.patch[static_cast<std::size_t>(seed)] = patch;
    std::vector<Index> waiting{seed};
    while (!waiting.empty()) {
      const Index t = waiting.back();
      waiting.pop_back();
      for (const Index v : surface_.triangle(t))
        for (const Index next : around_.row(v)) {
          Index& its_patch = planes_.patch[static_cast<std::size_t>(next)];
          if (its_patch >= 0 || !is_in_plane(next, seed)) continue;
          its_patch = patch;
          waiting.push_back(next);
        }
    }
  }

  /// Lies t on the side and in the plane of `seed`? Comparing with the seed only, a patch cannot bend bit by bit.
  bool is_in_plane(Index t, Index seed) const {
    const auto i = static_cast<std::size_t>(t), j = static_cast<std::size_t>(seed);
    if (surface_.side[i] != surface_.side[j]) return false;
    const Vec3 normal = planes_.normal[j], X = surface_.corners(seed)[0];
    if (norm(planes_.normal[i] - normal) > kSameNormal) return false;
    const auto corners = surface_.corners(t);
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& Y) { return std::abs(dot(normal, Y - X)) <= tolerance_; });
  }

  const TriangleSurface& surface_;
  Csr<Index> around_;
  double tolerance_;
  SurfacePlanes planes_;
};

}  // namespace

SurfacePlanes find_planes(const TriangleSurface& surface) { return Patches(surface).find(); }

}  // namespace tessera
