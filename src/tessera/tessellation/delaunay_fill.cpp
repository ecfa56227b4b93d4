#include "tessera/tessellation/delaunay_fill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tessera/base/error.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/tessellation/delaunay.hpp"

namespace tessera {
namespace {

constexpr double flatness = 1e-12;  // of the mean volume

double flat_limit(std::span<const Tetrahedron> tetrahedra, std::span<const Vec3> points) {
  const double sum = parallel::sum<double>(static_cast<std::int64_t>(tetrahedra.size()), [&](std::int64_t i) {
    return six_volume(tetrahedra[static_cast<std::size_t>(i)], points);
  });
  return flatness * sum / static_cast<double>(std::max<std::size_t>(tetrahedra.size(), 1));
}

/// Of a tetrahedron.
struct SmallestVolume {
  double six = std::numeric_limits<double>::infinity();
  SmallestVolume& operator+=(const SmallestVolume& o) {
    six = std::min(six, o.six);
    return *this;
  }
};

double smallest_six_volume(std::span<const Tetrahedron> tetrahedra, std::span<const Vec3> points) {
  const auto n = static_cast<std::int64_t>(tetrahedra.size());
  return parallel::sum<SmallestVolume>(
             n,
             [&](std::int64_t i) {
               return SmallestVolume{six_volume(tetrahedra[static_cast<std::size_t>(i)], points)};
             })
      .six;
}

/// For each tetrahedron, whether it is flat and shows one of its faces outside.
std::vector<char> flat_and_outer(std::span<const Tetrahedron> tetrahedra, std::span<const Vec3> points, double limit) {
  std::vector<char> result(tetrahedra.size(), 0);
  const std::vector<TetrahedronFace> faces = sorted_faces(tetrahedra);
  for_each_face(faces, [&](std::span<const TetrahedronFace> uses) {
    const auto t = static_cast<std::size_t>(uses[0].tetrahedron);
    if (uses.size() == 1 && six_volume(tetrahedra[t], points) <= limit) result[t] = 1;
  });
  return result;
}

/// Drops the tetrahedra whose centroid is outside.
void keep_inside(std::vector<Tetrahedron>& tetrahedra, std::span<const Vec3> points, const Solid& solid) {
  std::vector<char> inside(tetrahedra.size());
  parallel::for_each(static_cast<std::int64_t>(tetrahedra.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    inside[k] = solid.contains(centroid(tetrahedra[k], points), 0.0) ? 1 : 0;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
    if (inside[i] != 0) tetrahedra[kept++] = tetrahedra[i];
  tetrahedra.resize(kept);
}

/// Peels flat tetrahedra off the boundary, layer by layer. One inside must stay, or its neighbours would not match.
void peel_flat(std::vector<Tetrahedron>& tetrahedra, std::span<const Vec3> points, double limit) {
  while (smallest_six_volume(tetrahedra, points) <= limit) {
    const std::vector<char> drop = flat_and_outer(tetrahedra, points, limit);
    std::vector<Tetrahedron> kept;
    for (std::size_t i = 0; i < tetrahedra.size(); ++i)
      if (drop[i] == 0) kept.push_back(tetrahedra[i]);
    if (kept.size() == tetrahedra.size()) return;
    tetrahedra = std::move(kept);
  }
}

void refuse_not_positive(std::span<const Tetrahedron> tetrahedra, std::span<const Vec3> points) {
  if (smallest_six_volume(tetrahedra, points) > 0.0) return;
  for (const Tetrahedron& t : tetrahedra) {
    if (six_volume(t, points) > 0.0) continue;
    const Vec3 X = centroid(t, points);
    throw GeometryError(fmt::format(
        "particles {} near ({:.6g}, {:.6g}, {:.6g}) lie in one plane and on one circle to within rounding, so their "
        "Delaunay "
        "tetrahedron is flat: move one of them by more than 1e-9 of the spacing, or give a lattice a little jitter",
        fmt::join(t, ", "), X.x, X.y, X.z));
  }
}

}  // namespace

std::vector<Tetrahedron> delaunay_fill(std::span<const Vec3> points, const Solid& solid,
                                       std::span<const double> weights) {
  std::vector<Tetrahedron> tetrahedra = delaunay_tetrahedra(points, weights);
  keep_inside(tetrahedra, points, solid);
  peel_flat(tetrahedra, points, flat_limit(tetrahedra, points));
  refuse_not_positive(tetrahedra, points);
  return tetrahedra;
}

}  // namespace tessera
