#include "tessera/tessellation/surface_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tessera/base/error.hpp"
#include "tessera/geometry/predicates.hpp"

namespace tessera {
namespace {

enum Kind : Index { corner_of_cells, edge_through_triangle, edge_through_face, vertex_of_surface };

/// Sines of angles above this leave a crossing accurate in ordinary arithmetic.
constexpr double kSteep = 1e-3;

/// normal . (x - base) = value for three planes whose unit normals span `determinant`.
Vec3 common_point(const std::array<Vec3, 3>& n, const Vec3& value, double determinant) {
  const auto solve = [&](const Vec3& right) {
    return (1.0 / determinant) *
           (right.x * cross(n[1], n[2]) + right.y * cross(n[2], n[0]) + right.z * cross(n[0], n[1]));
  };
  const Vec3 x = solve(value);
  return x + solve(value - Vec3{dot(n[0], x), dot(n[1], x), dot(n[2], x)});
}

}  // namespace

void SurfaceLines::find(const DualCell& cell) {
  cell_ = &cell;
  X_ = generator(cell.particle);
  crossings_.find(cell);
  points_.clear();
  lines_.clear();
  cut_ends_.clear();
  add_corners();
  trace_cell_edges();
  trace_surface_edges();
  trace_cuts();
}

const Vec3& SurfaceLines::surface_vertex(Index u) const {
  return index_.surface().vertex(crossings_.vertices[static_cast<std::size_t>(u)]);
}

Index SurfaceLines::add_point(const Vec3& X, const Name& name) {
  points_.push_back({X - X_, name});
  return static_cast<Index>(points_.size()) - 1;
}

/// On both bisectors and the triangle to round-off; between the corners at the ends where the edge is nearly parallel
/// to the triangle.
Vec3 SurfaceLines::place(const EdgeCrossing& crossing, const std::array<Index, 3>& g) const {
  const Index t = crossings_.triangles[static_cast<std::size_t>(crossing.triangle)];
  const auto [u0, u1, u2] = index_.surface().corners(t);
  const Vec3& base = generator(g[0]);
  const Vec3 to_first = generator(g[1]) - base, to_second = generator(g[2]) - base;
  const double first = norm(to_first), second = norm(to_second);
  const std::array<Vec3, 3> n{to_first / first, to_second / second, planes_.normal[static_cast<std::size_t>(t)]};
  const double determinant = dot(n[0], cross(n[1], n[2]));
  if (std::abs(determinant) > kSteep)
    return base + common_point(n,
                               {generators_.distance(g[0], g[1], first), generators_.distance(g[0], g[2], second),
                                dot(n[2], u0 - base)},
                               determinant);
  const CellEdge& edge = crossings_.cell_edges[static_cast<std::size_t>(crossing.edge)];
  const DualCell::Corner *low = &cell_->corner(edge.from), *high = &cell_->corner(edge.to);
  if (high->name < low->name) std::swap(low, high);
  return low->X + crossing_fraction(u0, u1, u2, low->X, high->X) * (high->X - low->X);
}

/// On the edge of the surface, and on the bisector to round-off.
Vec3 SurfaceLines::place(const FaceCrossing& crossing) const {
  const SurfaceEdge& edge = crossings_.surface_edges[static_cast<std::size_t>(crossing.edge)];
  const Vec3 &low = surface_vertex(edge.low), &high = surface_vertex(edge.high);
  const Index g = std::min(cell_->particle, neighbour(crossing.face)),
              h = std::max(cell_->particle, neighbour(crossing.face));
  const Vec3 branch = generator(h) - generator(g);
  const double length = norm(branch), distance = generators_.distance(g, h, length);
  const auto height = [&](const Vec3& U) { return dot(branch, U - generator(g)) / length - distance; };
  const double at_low = height(low), at_high = height(high);
  double s = 0.0;
  if (std::abs(at_low - at_high) > kSteep * norm(high - low)) {
    s = std::clamp(at_low / (at_low - at_high), 0.0, 1.0);
  } else {
    const auto corner = [&](std::size_t i) { return cell_->corner(crossing.corners[i]).X; };
    s = crossing_fraction(corner(0), corner(1), corner(2), low, high);
  }
  return low + s * (high - low);
}

void SurfaceLines::add_corners() {
  for (const DualCell::Corner& c : cell_->corners)
    add_point(c.X, {corner_of_cells, c.name[0], c.name[1], c.name[2], c.name[3]});
}

void SurfaceLines::add_end(int count, double at, Index point) {
  for (; count > 0; --count) begins_.push_back({at, point});
  for (; count < 0; ++count) ends_.push_back({at, point});
}

/// Joins the first beginning with the first end, and so on: on a line through a solid they take turns.
template <class Emit>
void SurfaceLines::join_ends(Emit&& emit) {
  if (begins_.size() != ends_.size())
    throw GeometryError(
        fmt::format("the surface cannot be cut at particle {} at ({:g}, {:g}, {:g}) m: it is not closed or crosses "
                    "itself there",
                    cell_->particle, X_.x, X_.y, X_.z));
  const auto before = [&](const End& a, const End& b) {
    return a.at != b.at
               ? a.at < b.at
               : points_[static_cast<std::size_t>(a.point)].name < points_[static_cast<std::size_t>(b.point)].name;
  };
  std::sort(begins_.begin(), begins_.end(), before);
  std::sort(ends_.begin(), ends_.end(), before);
  for (std::size_t i = 0; i < begins_.size(); ++i) emit(begins_[i].point, ends_[i].point);
  begins_.clear();
  ends_.clear();
}

/// The edges of the cell within the solid. At a crossing into the solid the line along the edge begins, so the line on
/// the left face that leads there along the triangle ends.
void SurfaceLines::trace_cell_edges() {
  auto crossing = crossings_.edge_crossings.begin();
  for (Index e = 0; e < static_cast<Index>(crossings_.cell_edges.size()); ++e) {
    const CellEdge& edge = crossings_.cell_edges[static_cast<std::size_t>(e)];
    const Vec3 &from = cell_->corner(edge.from).X, &to = cell_->corner(edge.to).X;
    add_end(crossings_.corner_in[static_cast<std::size_t>(edge.from)], 0.0, edge.from);
    add_end(-crossings_.corner_in[static_cast<std::size_t>(edge.to)], norm2(to - from), edge.to);
    for (; crossing != crossings_.edge_crossings.end() && crossing->edge == e; ++crossing) {
      std::array<Index, 3> g{cell_->particle, neighbour(edge.left), neighbour(edge.right)};
      std::sort(g.begin(), g.end());
      const Vec3 X = place(*crossing, g);
      const Index t = crossings_.triangles[static_cast<std::size_t>(crossing->triangle)];
      const Index point = add_point(X, {edge_through_triangle, g[0], g[1], g[2], t});
      add_end(crossing->sign, dot(X - from, to - from), point);
      cut_ends_.push_back({edge.left, crossing->triangle, point, -crossing->sign});
      cut_ends_.push_back({edge.right, crossing->triangle, point, crossing->sign});
    }
    join_ends([&](Index p, Index q) {
      lines_.push_back({edge.left, p, q});
      lines_.push_back({edge.right, q, p});
    });
  }
}

/// The edges of the surface within the cell. Where an edge, in the sense of a triangle, leaves the cell, the line on
/// the triangle along the face begins; on the face it runs the other way and ends.
void SurfaceLines::trace_surface_edges() {
  struct Side {
    Index edge, triangle;
    int direction;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < crossings_.triangles.size(); ++t)
    for (const TriangleEdge& edge : crossings_.boundary[t])
      sides.push_back({edge.edge, static_cast<Index>(t), edge.direction});
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle); });

  vertex_point_.assign(crossings_.vertices.size(), -1);
  const auto point_at = [&](Index u) {
    Index& point = vertex_point_[static_cast<std::size_t>(u)];
    if (point < 0)
      point = add_point(surface_vertex(u), {vertex_of_surface, crossings_.vertices[static_cast<std::size_t>(u)]});
    return point;
  };
  auto crossing = crossings_.face_crossings.begin();
  auto side = sides.begin();
  for (Index e = 0; e < static_cast<Index>(crossings_.surface_edges.size()); ++e) {
    const SurfaceEdge& edge = crossings_.surface_edges[static_cast<std::size_t>(e)];
    const auto first_side = side;
    while (side != sides.end() && side->edge == e) ++side;
    const int low_in = crossings_.vertex_in[static_cast<std::size_t>(edge.low)];
    const int high_in = crossings_.vertex_in[static_cast<std::size_t>(edge.high)];
    const Vec3 &low = surface_vertex(edge.low), &high = surface_vertex(edge.high);
    if (low_in != 0) add_end(low_in, 0.0, point_at(edge.low));
    if (high_in != 0) add_end(-high_in, norm2(high - low), point_at(edge.high));
    for (; crossing != crossings_.face_crossings.end() && crossing->edge == e; ++crossing) {
      const Vec3 X = place(*crossing);
      const auto [g, h] = std::minmax({cell_->particle, neighbour(crossing->face)});
      const Index point =
          add_point(X, {edge_through_face, g, h, crossings_.vertices[static_cast<std::size_t>(edge.low)],
                        crossings_.vertices[static_cast<std::size_t>(edge.high)]});
      add_end(crossing->sign, dot(X - low, high - low), point);
      for (auto s = first_side; s != side; ++s)
        cut_ends_.push_back({crossing->face, s->triangle, point, crossing->sign * s->direction});
    }
    join_ends([&](Index p, Index q) {
      for (auto s = first_side; s != side; ++s)
        lines_.push_back({cell_->faces() + s->triangle, s->direction > 0 ? p : q, s->direction > 0 ? q : p});
    });
  }
}

/// The lines that faces and triangles have in common, from one end to the other.
void SurfaceLines::trace_cuts() {
  std::sort(cut_ends_.begin(), cut_ends_.end(), [](const CutEnd& a, const CutEnd& b) {
    return std::tie(a.face, a.triangle, a.point) < std::tie(b.face, b.triangle, b.point);
  });
  for (auto first = cut_ends_.begin(); first != cut_ends_.end();) {
    const Index f = first->face, t = first->triangle;
    const Index triangle = crossings_.triangles[static_cast<std::size_t>(t)];
    const Vec3 along = cross(generator(neighbour(f)) - X_, planes_.normal[static_cast<std::size_t>(triangle)]);
    for (; first != cut_ends_.end() && first->face == f && first->triangle == t; ++first)
      add_end(first->sign, dot(along, points_[static_cast<std::size_t>(first->point)].X), first->point);
    join_ends([&](Index p, Index q) {
      lines_.push_back({f, p, q});
      lines_.push_back({cell_->faces() + t, q, p});
    });
  }
}

}  // namespace tessera
