#include "tessera/tessellation/delaunay.hpp"

#include "tessera/base/error.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

#ifdef TESSERA_HAS_CGAL

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace tessera {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
using Storage = CGAL::Triangulation_data_structure_3<Vertex, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Storage>;

std::vector<std::pair<Kernel::Point_3, Index>> numbered(std::span<const Vec3> points) {
  std::vector<std::pair<Kernel::Point_3, Index>> result;
  result.reserve(points.size());
  for (const Vec3& X : points) result.emplace_back(Kernel::Point_3(X.x, X.y, X.z), static_cast<Index>(result.size()));
  return result;
}

}  // namespace

bool has_delaunay() { return true; }

std::vector<Tetrahedron> delaunay_tetrahedra(std::span<const Vec3> points) {
  const auto input = numbered(points);
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

std::vector<Tetrahedron> delaunay_tetrahedra(std::span<const Vec3>) {
  throw GeometryError(
      "this build cannot compute Delaunay tetrahedra: install CGAL (Debian: libcgal-dev) and build with "
      "TESSERA_WITH_CGAL=ON, or use a lattice or a tetrahedral mesh file");
}

}  // namespace tessera

#endif
