#include "tessera/tessellation/surface_mesher.hpp"

#include "tessera/base/error.hpp"

#ifdef TESSERA_HAS_CGAL

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <unordered_map>

namespace tessera {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Polyhedron = CGAL::Surface_mesh<Point>;
using Domain =
    CGAL::Mesh_domain_with_polyline_features_3<CGAL::Polyhedral_mesh_domain_3<Polyhedron, Kernel, CGAL::Default, int>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

// Largest circumscribed radii of tetrahedra and triangles, in spacings; then edges are about a spacing long.
constexpr double cell_size = 1.0, facet_size = 0.85;
// How far facets may be from a curved side, in spacings.
constexpr double facet_distance = 0.05;

/// The local length of edges, times a factor, as CGAL asks for it.
struct Size {
  using FT = Kernel::FT;
  using Point_3 = Point;
  using Index = Domain::Index;

  const SurfaceMeshSpec& spec;
  double factor = 1.0;

  Size times(double f) const { return {spec, f * factor}; }
  FT operator()(const Point_3& p, int, const Index&) const {
    return factor * (spec.size ? spec.size({p.x(), p.y(), p.z()}) : spec.spacing);
  }
};

Point to_cgal(const Vec3& X) { return {X.x, X.y, X.z}; }

/// With the number of its patch, from one, at every face.
Polyhedron to_cgal(const TriangleSurface& surface, const std::vector<Index>& patch) {
  std::vector<Point> points;
  for (const Vec3& X : surface.vertices) points.push_back(to_cgal(X));
  std::vector<std::vector<std::size_t>> triangles;
  for (const Triangle& t : surface.triangles)
    triangles.push_back(
        {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, triangles);  // doubles vertices where the surface branches
  Polyhedron polyhedron;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, polyhedron);
  auto number = polyhedron.add_property_map<Polyhedron::Face_index, int>("f:patch_id", 1).first;
  for (const auto face : polyhedron.faces()) number[face] = 1 + patch[static_cast<std::size_t>(face)];
  return polyhedron;
}

std::vector<std::vector<Point>> to_cgal(const std::vector<FeatureLine>& lines, const TriangleSurface& surface) {
  std::vector<std::vector<Point>> result;
  for (const FeatureLine& line : lines) {
    result.emplace_back();
    for (const Index v : line) result.back().push_back(to_cgal(surface.vertex(v)));
  }
  return result;
}

RawMesh from_cgal(const Complex& complex) {
  RawMesh mesh;
  std::unordered_map<Triangulation::Vertex_handle, Index> number;
  const auto number_of = [&](Triangulation::Vertex_handle v) {
    const auto [it, is_new] = number.emplace(v, static_cast<Index>(mesh.points.size()));
    const auto& p = v->point();
    if (is_new) mesh.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    return it->second;
  };
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    mesh.tetrahedra.push_back({number_of(cell->vertex(0)), number_of(cell->vertex(1)), number_of(cell->vertex(2)),
                               number_of(cell->vertex(3))});
  return mesh;
}

}  // namespace

bool has_cgal_mesher() { return true; }

RawMesh mesh_with_cgal(const TriangleSurface& surface, const SurfaceFeatures& features, const SurfaceMeshSpec& spec) {
  CGAL::get_default_random() = CGAL::Random(0);  // else seeded by the clock
  const Polyhedron polyhedron = to_cgal(surface, features.patch);
  Domain domain(polyhedron, &CGAL::get_default_random());
  const auto lines = to_cgal(features.lines, surface);
  domain.add_features(lines.begin(), lines.end());
  namespace params = CGAL::parameters;
  const Size size{spec};
  const Criteria criteria(params::edge_size = size, params::facet_angle = 25.0,
                          params::facet_size = size.times(facet_size),
                          params::facet_distance = size.times(facet_distance),
                          params::facet_topology = CGAL::FACET_VERTICES_ON_SAME_SURFACE_PATCH,
                          params::cell_radius_edge_ratio = 2.0, params::cell_size = size.times(cell_size));
  // Perturbing and exuding slivers depends on addresses in memory, and with it the particles would.
  return from_cgal(CGAL::make_mesh_3<Complex>(domain, criteria, params::no_perturb(), params::no_exude()));
}

}  // namespace tessera

#else

namespace tessera {

bool has_cgal_mesher() { return false; }

RawMesh mesh_with_cgal(const TriangleSurface&, const SurfaceFeatures&, const SurfaceMeshSpec&) {
  throw GeometryError(
      "mesher = \"cgal\" is not in this build (CGAL's Mesh_3 is GPL); build with TESSERA_WITH_CGAL=ON, or take mesher "
      "= "
      "\"gmsh\", or give a mesh that another program made: particles = { mesh = \"part.msh\" }");
}

}  // namespace tessera

#endif
