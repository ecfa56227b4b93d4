#include "tessera/tessellation/mesh_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tessera/base/csr.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {
namespace {

bool lies_in(const Plane& plane, const Triangle& triangle, std::span<const Vec3> points, double tolerance) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](Index v) { return std::abs(plane.height(points[static_cast<std::size_t>(v)])) <= tolerance; });
}

bool holds(const ConvexPiece& piece, const Vec3& X, double tolerance) {
  return std::all_of(piece.walls.begin(), piece.walls.end(),
                     [&](const ConvexPiece::Wall& wall) { return wall.plane.height(X) <= tolerance; });
}

bool is_wall_at(const Solid& solid, Index side, const Vec3& X, double tolerance) {
  for (const ConvexPiece& piece : solid.pieces)
    for (const ConvexPiece::Wall& wall : piece.walls)
      if (wall.side == side && std::abs(wall.plane.height(X)) <= tolerance && holds(piece, X, tolerance)) return true;
  return false;
}

/// The other two vertices of a face seen from outside, whose smallest vertex is known.
struct SmallFace {
  Index left = 0, right = 0;

  bool comes_before(const SmallFace& o) const { return key() != o.key() ? key() < o.key() : left < o.left; }
  /// Equal for the two sides of one face.
  std::pair<Index, Index> key() const { return std::minmax({left, right}); }
};

/// Where the tetrahedra of each smallest vertex begin, up to the largest vertex of all.
std::vector<std::size_t> first_of_vertices(std::span<const Tetrahedron> tetrahedra) {
  Index largest = -1;
  for (const Tetrahedron& t : tetrahedra) largest = std::max({largest, t[2], t[3]});
  std::vector<std::size_t> first(static_cast<std::size_t>(largest) + 2, 0);
  for (const Tetrahedron& t : tetrahedra) ++first[static_cast<std::size_t>(t[0]) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

/// The faces opposite to the smallest vertices, by their own smallest vertex.
Csr<SmallFace> faces_at_second_vertices(std::span<const Tetrahedron> tetrahedra, Index vertices) {
  Csr<SmallFace> faces;
  const Csr<Tetrahedron> at = group_by_row(vertices, tetrahedra, [](const Tetrahedron& t) { return t[1]; });
  faces.offset = at.offset;
  faces.value.reserve(at.value.size());
  for (const Tetrahedron& t : at.value) faces.value.push_back({t[2], t[3]});
  return faces;
}

/// The faces of a tetrahedron at its smallest vertex.
void add_faces_at_first(const Tetrahedron& t, std::vector<SmallFace>& faces) {
  faces.push_back({t[2], t[1]});
  faces.push_back({t[1], t[3]});
  faces.push_back({t[3], t[2]});
}

/// Hands out those of the faces at v that are there once, sorted.
void add_single(Index v, std::vector<SmallFace>& faces, parallel::RowCollector<Triangle>& single) {
  std::sort(faces.begin(), faces.end(), [](const SmallFace& a, const SmallFace& b) { return a.comes_before(b); });
  std::vector<Triangle> outer;
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    while (end < faces.size() && faces[end].key() == faces[i].key()) ++end;
    if (end - i == 1) outer.push_back({v, faces[i].left, faces[i].right});
  }
  std::sort(outer.begin(), outer.end());
  for (const Triangle& t : outer) single.add(t);
}

}  // namespace

std::vector<Triangle> outer_faces(std::span<const Tetrahedron> tetrahedra) {
  // The faces with the smallest vertex v: three of each tetrahedron whose smallest vertex it is, which lie together,
  // and one of each whose second smallest it is.
  const std::vector<std::size_t> first = first_of_vertices(tetrahedra);
  const Csr<SmallFace> of_second = faces_at_second_vertices(tetrahedra, static_cast<Index>(first.size()) - 1);
  return parallel::collect_rows<Triangle>(of_second.rows(),
                                          [&](Index v, parallel::RowCollector<Triangle>& outer) {
                                            thread_local std::vector<SmallFace> faces;
                                            const std::span<const SmallFace> more = of_second.row(v);
                                            faces.assign(more.begin(), more.end());
                                            const auto row = static_cast<std::size_t>(v);
                                            for (std::size_t i = first[row]; i < first[row + 1]; ++i)
                                              add_faces_at_first(tetrahedra[i], faces);
                                            add_single(v, faces, outer);
                                          })
      .value;
}

Index side_of(const Triangle& triangle, std::span<const Vec3> points, const Solid& solid, double tolerance) {
  const Vec3 area = area_vector(triangle, points);
  const Vec3 middle = centroid(triangle, points);
  for (std::size_t i = 0; i < solid.sides.size(); ++i) {
    const Plane& plane = solid.sides[i].plane;
    if (dot(area, plane.normal) <= 0.0 || !lies_in(plane, triangle, points, tolerance)) continue;
    if (is_wall_at(solid, static_cast<Index>(i), middle, tolerance)) return static_cast<Index>(i);
  }
  return -1;
}

}  // namespace tessera
