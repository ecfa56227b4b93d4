#include "tessera/tessellation/delaunay_fill.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/base/error.hpp"
#include "tessera/tessellation/delaunay.hpp"

namespace tessera {
namespace {

constexpr double flatness = 1e-12;  // of the mean volume

double flat_limit(std::span<const Tetrahedron> tetrahedra, std::span<const Vec3> points) {
  double sum = 0.0;
  for (const Tetrahedron& t : tetrahedra) sum += six_volume(t, points);
  return flatness * sum / static_cast<double>(std::max<std::size_t>(tetrahedra.size(), 1));
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

/// Peels flat tetrahedra off the boundary, layer by layer. One inside must stay, or its neighbours would not match.
void peel_flat(std::vector<Tetrahedron>& tetrahedra, std::span<const Vec3> points, double limit) {
  const auto is_flat = [&](const Tetrahedron& t) { return six_volume(t, points) <= limit; };
  while (std::any_of(tetrahedra.begin(), tetrahedra.end(), is_flat)) {
    const std::vector<char> drop = flat_and_outer(tetrahedra, points, limit);
    std::vector<Tetrahedron> kept;
    for (std::size_t i = 0; i < tetrahedra.size(); ++i)
      if (drop[i] == 0) kept.push_back(tetrahedra[i]);
    if (kept.size() == tetrahedra.size()) return;
    tetrahedra = std::move(kept);
  }
}

void refuse_not_positive(std::span<const Tetrahedron> tetrahedra, std::span<const Vec3> points) {
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
  std::vector<Tetrahedron> tetrahedra;
  for (const Tetrahedron& t : delaunay_tetrahedra(points, weights))
    if (solid.contains(centroid(t, points), 0.0)) tetrahedra.push_back(t);
  peel_flat(tetrahedra, points, flat_limit(tetrahedra, points));
  refuse_not_positive(tetrahedra, points);
  return tetrahedra;
}

}  // namespace tessera
