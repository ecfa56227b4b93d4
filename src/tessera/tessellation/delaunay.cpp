#include "tessera/tessellation/delaunay.hpp"

#include "tessera/base/error.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

#ifdef TESSERA_HAS_CGAL

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace tessera {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WeightedPoint = Kernel::Weighted_point_3;
using Vertex =
    CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Storage = CGAL::Triangulation_data_structure_3<Vertex, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Storage>;

/// Minus the change of the squared distance from the origin: a quadratic form, so that a lattice stays a lattice. The
/// mixed terms make the diagonal 000-111 of an axis-parallel cell its shortest; nothing else depends on the numbers.
double metric_change(const Vec3& X) {
  return 1e-6 * (X.x * X.y + 0.8 * X.y * X.z + 0.6 * X.z * X.x + 0.3 * X.y * X.y - 0.2 * X.z * X.z);
}

std::vector<std::pair<WeightedPoint, Index>> numbered(std::span<const Vec3> points, std::span<const double> weights) {
  std::vector<std::pair<WeightedPoint, Index>> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& X = points[i];
    const double weight = weights[i] + metric_change(X - points[0]);
    result.emplace_back(WeightedPoint({X.x, X.y, X.z}, weight), static_cast<Index>(i));
  }
  return result;
}

}  // namespace

bool has_delaunay() { return true; }

std::vector<Tetrahedron> delaunay_tetrahedra(std::span<const Vec3> points, std::span<const double> weights) {
  const auto input = numbered(points, weights);
  const Triangulation triangulation(input.begin(), input.end());
  if (triangulation.dimension() < 3)
    throw GeometryError(
        "the particles lie in one plane or are fewer than four: tetrahedra need at least two layers in every "
        "direction");
  std::vector<Tetrahedron> tetrahedra;
  tetrahedra.reserve(triangulation.number_of_finite_cells());
  for (const auto& cell : triangulation.finite_cell_handles())
    tetrahedra.push_back(
        {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
  return tetrahedra;
}

}  // namespace tessera

#else

namespace tessera {

bool has_delaunay() { return false; }

std::vector<Tetrahedron> delaunay_tetrahedra(std::span<const Vec3>, std::span<const double>) {
  throw GeometryError(
      "this build cannot compute Delaunay tetrahedra: install CGAL (Debian: libcgal-dev) and build with "
      "TESSERA_WITH_CGAL=ON, or use a lattice or a tetrahedral mesh file");
}

}  // namespace tessera

#endif
