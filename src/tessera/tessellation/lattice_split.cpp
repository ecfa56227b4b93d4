#include "tessera/tessellation/lattice_split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

using Cell = std::array<Index, 3>;

// Bit d of a corner's number says whether it lies at the upper end in direction d.
using Corners = std::array<Index, 8>;

// The ways from corner 0 to corner 7, one for every order of the directions; positive orientation.
constexpr std::array<std::array<std::size_t, 4>, 6> paths{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

Corners corners_of(const Lattice& lattice, const Cell& cell) {
  Corners corners{};
  for (unsigned c = 0; c < 8; ++c) {
    const std::size_t i = static_cast<std::size_t>(cell[0]) + (c & 1u);
    const std::size_t j = static_cast<std::size_t>(cell[1]) + (c >> 1 & 1u);
    const std::size_t k = static_cast<std::size_t>(cell[2]) + (c >> 2 & 1u);
    const auto nx = static_cast<std::size_t>(lattice.nodes[0]), ny = static_cast<std::size_t>(lattice.nodes[1]);
    corners[c] = lattice.particle[i + nx * (j + ny * k)];
  }
  return corners;
}

Vec3 centre_of(const Lattice& lattice, const Cell& cell) {
  Vec3 X = lattice.origin;
  for (int d = 0; d < 3; ++d)
    X[d] += (static_cast<double>(cell[static_cast<std::size_t>(d)]) + 0.5) * lattice.spacing[d];
  return X;
}

[[noreturn]] void throw_inverted(const Cell& cell, const Corners& corners, const Vec3& X) {
  throw GeometryError(fmt::format(
      "splitting the lattice inverts a tetrahedron in cell ({}, {}, {}) at ({:.6g}, {:.6g}, {:.6g}), particles {}: "
      "use less jitter, or Delaunay tetrahedra (a build with CGAL)",
      cell[0], cell[1], cell[2], X.x, X.y, X.z, fmt::join(corners, ", ")));
}

void split_cell(const PointSet& set, const Cell& cell, const Solid& solid, std::vector<Tetrahedron>& tetrahedra) {
  const Corners corners = corners_of(*set.lattice, cell);
  if (std::find(corners.begin(), corners.end(), -1) != corners.end()) return;
  const Vec3 centre = centre_of(*set.lattice, cell);
  if (!solid.contains(centre, 0.0)) return;
  const Vec3& h = set.lattice->spacing;
  const double smallest = 1e-12 * h.x * h.y * h.z;
  for (const auto& path : paths) {
    const Tetrahedron t{corners[path[0]], corners[path[1]], corners[path[2]], corners[path[3]]};
    if (six_volume(t, set.points) <= smallest) throw_inverted(cell, corners, centre);
    tetrahedra.push_back(t);
  }
}

}  // namespace

std::vector<Tetrahedron> split_lattice(const PointSet& points, const Solid& solid) {
  if (!points.lattice)
    throw GeometryError(
        "these particles come from no lattice, so its cells cannot be split: use a build with CGAL, or a tetrahedral "
        "mesh file");
  const auto [nx, ny, nz] = points.lattice->nodes;
  std::vector<Tetrahedron> tetrahedra;
  for (Index k = 0; k + 1 < nz; ++k)
    for (Index j = 0; j + 1 < ny; ++j)
      for (Index i = 0; i + 1 < nx; ++i) split_cell(points, {i, j, k}, solid, tetrahedra);
  return tetrahedra;
}

}  // namespace tessera
