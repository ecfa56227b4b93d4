#include "tessera/geometry/surface_tree.hpp"

#ifdef TESSERA_HAS_CGAL

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace tessera {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Number = Kernel::FT;
using Mesh = CGAL::Surface_mesh<Point>;
using Sides = Mesh::Property_map<Mesh::Face_index, Index>;

/// Coordinates of flat axis-parallel faces of two parts that differ by less than this part of their size are equal:
/// what round-off makes of decimal fractions, as 0.1 + 0.2 of 0.3.
constexpr double kCoincidence = 1e-12;

Sides sides_of(Mesh& mesh) { return mesh.add_property_map<Mesh::Face_index, Index>("f:side", -1).first; }

Mesh mesh_of(const TriangleSurface& surface) {
  std::vector<Point> points;
  for (const Vec3& X : surface.vertices) points.emplace_back(X.x, X.y, X.z);
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& [a, b, c] : surface.triangles)
    triangles.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  // Where the surface touches itself at edges or vertices, these become several.
  if (!pmp::is_polygon_soup_a_polygon_mesh(triangles)) pmp::orient_polygon_soup(points, triangles);
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  Sides sides = sides_of(mesh);
  for (const Mesh::Face_index f : mesh.faces()) sides[f] = surface.side[f.idx()];
  return mesh;
}

TriangleSurface surface_of(Mesh& mesh) {
  TriangleSurface surface;
  std::vector<Index> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    number[v.idx()] = static_cast<Index>(surface.vertices.size());
    const auto& exact = CGAL::exact(mesh.point(v));
    surface.vertices.push_back({CGAL::to_double(exact.x()), CGAL::to_double(exact.y()), CGAL::to_double(exact.z())});
  }
  const Sides sides = sides_of(mesh);
  for (const Mesh::Face_index f : mesh.faces()) {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) triangle[corner++] = number[v.idx()];
    surface.triangles.push_back(triangle);
    surface.side.push_back(sides[f]);
  }
  return surface;
}

void apply(const AffineMap& map, Mesh& mesh) {
  if (map.is_identity()) return;
  const Mat3& A = map.A;
  const Kernel::Aff_transformation_3 moved(A(0, 0), A(0, 1), A(0, 2), map.shift.x, A(1, 0), A(1, 1), A(1, 2),
                                           map.shift.y, A(2, 0), A(2, 1), A(2, 2), map.shift.z);
  for (const Mesh::Vertex_index v : mesh.vertices()) mesh.point(v) = moved(mesh.point(v));
}

AffineMap after(const AffineMap& outer, const AffineMap& inner) { return {outer.A * inner.A, outer(inner.shift)}; }

Bounds bounds_of(const Mesh& mesh, const AffineMap& outer) {
  Bounds box;
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    box.include(outer({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}));
  }
  return box;
}

/// The sides go with the pieces into which faces are divided, and with faces that are copied into the result.
struct CarrySides : pmp::Corefinement::Default_visitor<Mesh> {
  std::map<const Mesh*, Sides>* sides;
  Index divided = -1;

  explicit CarrySides(std::map<const Mesh*, Sides>& of_meshes) : sides(&of_meshes) {}
  void before_subface_creations(Mesh::Face_index f, Mesh& mesh) { divided = sides->at(&mesh)[f]; }
  void after_subface_created(Mesh::Face_index f, Mesh& mesh) { sides->at(&mesh)[f] = divided; }
  void after_face_copy(Mesh::Face_index from, Mesh& mesh, Mesh::Face_index to, Mesh& result) {
    sides->at(&result)[to] = sides->at(&mesh)[from];
  }
};

/// The exact coordinates along an axis of all faces that are flat across it.
std::vector<Number> flat_faces(const Mesh& mesh, int axis) {
  std::vector<Number> planes;
  for (const Mesh::Face_index f : mesh.faces()) {
    std::array<Number, 3> x;
    std::size_t corner = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) x[corner++] = mesh.point(v)[axis];
    if (x[0] == x[1] && x[1] == x[2]) planes.push_back(x[0]);
  }
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  return planes;
}

/// Puts flat axis-parallel faces of `b` into planes of such faces of `a` that they miss by round-off.
void join_planes(const Mesh& a, Mesh& b, double size) {
  const Number slack(kCoincidence * size);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<Number> targets = flat_faces(a, axis);
    std::map<Number, Number> moves;
    for (const Number& x : flat_faces(b, axis)) {
      const auto target = std::lower_bound(targets.begin(), targets.end(), x - slack);
      if (target != targets.end() && *target <= x + slack && *target != x) moves.emplace(x, *target);
    }
    if (moves.empty()) continue;
    for (const Mesh::Vertex_index v : b.vertices()) {
      const Point& p = b.point(v);
      const auto move = moves.find(p[axis]);
      if (move == moves.end()) continue;
      std::array<Number, 3> x{p.x(), p.y(), p.z()};
      x[static_cast<std::size_t>(axis)] = move->second;
      b.point(v) = Point(x[0], x[1], x[2]);
    }
  }
}

/// Has every edge its corners, the next edge and a face? Where parts miss each other by less than any number can tell,
/// pieces of the result may be missing.
bool is_whole(const Mesh& mesh) {
  const auto halfedges = mesh.halfedges();
  return std::all_of(halfedges.begin(), halfedges.end(), [&](const Mesh::Halfedge_index h) {
    return mesh.target(h).is_valid() && mesh.next(h).is_valid() && mesh.face(h).is_valid();
  });
}

/// Makes `result` of `a` and `b`; false when it is bounded by a surface that passes an edge more than once.
template <class Parameters>
bool combine(Boolean boolean, Mesh& a, Mesh& b, Mesh& result, const Parameters& carrying) {
  if (boolean == Boolean::unite) return pmp::corefine_and_compute_union(a, b, result, carrying);
  if (boolean == Boolean::subtract) return pmp::corefine_and_compute_difference(a, b, result, carrying);
  return pmp::corefine_and_compute_intersection(a, b, result, carrying);
}

/// What is left of `a` and `b`; nothing when that is no sound surface. With assertions CGAL finds some of these itself.
std::optional<Mesh> combined(Boolean boolean, Mesh& a, Mesh& b) {
  Mesh result;
  std::map<const Mesh*, Sides> sides{{&a, sides_of(a)}, {&b, sides_of(b)}, {&result, sides_of(result)}};
  try {
    if (!combine(boolean, a, b, result, CGAL::parameters::visitor(CarrySides(sides)))) return std::nullopt;
  } catch (const CGAL::Failure_exception&) {
    return std::nullopt;
  }
  if (!is_whole(result)) return std::nullopt;
  return result;
}

Mesh evaluate(SurfaceTree& tree, const AffineMap& outer) {
  const AffineMap here = after(outer, tree.map);
  Mesh mesh;
  if (tree.is_leaf()) mesh = mesh_of(tree.surface);
  for (std::size_t p = 0; p < tree.parts.size(); ++p) {
    Mesh part = evaluate(tree.parts[p], here);
    if (p == 0) {
      mesh = std::move(part);
      continue;
    }
    // What booleans have made must stay as it is: its flat faces may be pieces of others that would bend.
    const double size = norm(bounds_of(mesh, {}).size()) + norm(bounds_of(part, {}).size());
    if (tree.parts[p].is_leaf())
      join_planes(mesh, part, size);
    else if (p == 1 && tree.parts[0].is_leaf())
      join_planes(part, mesh, size);
    std::optional<Mesh> result = combined(tree.boolean, mesh, part);
    if (!result)
      throw InputError(tree.parts[p].origin,
                       "touches what comes before it along an edge only, or nearly so, so that it cannot be said what "
                       "is inside there; let the shapes overlap, share part of a face, or keep them apart");
    mesh = std::move(*result);
    if (mesh.number_of_faces() == 0 && tree.boolean != Boolean::unite)
      throw InputError(tree.parts[p].origin, tree.boolean == Boolean::subtract
                                                 ? "covers all that is left of the shape: the difference leaves nothing"
                                                 : "has nothing in common with the shapes before it");
  }
  apply(tree.map, mesh);
  tree.box = bounds_of(mesh, outer);
  return mesh;
}

}  // namespace

TriangleSurface evaluate(SurfaceTree& tree) {
  Mesh mesh = evaluate(tree, AffineMap{});
  return surface_of(mesh);
}

}  // namespace tessera

#else

namespace tessera {

TriangleSurface evaluate(SurfaceTree& tree) {
  throw InputError(tree.origin,
                   "a union, difference or intersection of other shapes than boxes needs CGAL's mesh processing, which "
                   "this build leaves out; build with TESSERA_WITH_CGAL, or give the solid as one file");
}

}  // namespace tessera

#endif
