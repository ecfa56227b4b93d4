#include "tessera/tessellation/surface_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/geometry/predicates.hpp"
#include "tessera/tessellation/surface_shifted.hpp"

namespace tessera {
namespace {

constexpr double kMargin = 1e-9;  // of the cell's size

Bounds box_around(const Vec3& a, const Vec3& b) {
  Bounds box;
  box.include(a);
  box.include(b);
  return box;
}

}  // namespace

void SurfaceCrossings::find(const DualCell& cell) {
  cell_ = &cell;
  X_ = generators_[static_cast<std::size_t>(cell.particle)];
  box_ = Bounds();
  box_.include(X_);
  for (const DualCell::Corner& corner : cell.corners) box_.include(corner.X);
  index_.triangles_near(box_, triangles);
  list_cell_edges();
  list_surface_edges();
  cross_triangles();
  measure_heights();
  cross_faces();
  vertex_in.clear();
  for (Index u = 0; u < static_cast<Index>(vertices.size()); ++u) vertex_in.push_back(place(u));
}

void SurfaceCrossings::list_cell_edges() {
  cell_edges.clear();
  for (Index c = 0; c < static_cast<Index>(cell_->corners.size()); ++c) {
    const auto& faces = cell_->corner(c).faces;
    for (std::size_t i = 0; i < 3; ++i) {  // leaves corner c along faces[i], with faces[i + 2] on the right
      const Index left = faces[i], right = faces[(i + 2) % 3];
      if (left > right) continue;
      const auto loop = cell_->face(left);
      const auto at = std::find(loop.begin(), loop.end(), c);
      cell_edges.push_back({c, at + 1 == loop.end() ? loop.front() : *(at + 1), left, right});
    }
  }
}

void SurfaceCrossings::list_surface_edges() {
  const TriangleSurface& surface = index_.surface();
  vertices.clear();
  triangle_box_.clear();
  for (const Index t : triangles) {
    triangle_box_.push_back(bounds(surface, t));
    for (const Index v : surface.triangle(t)) vertices.push_back(v);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto number = [&](Index v) {
    return static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  const auto before = [](const SurfaceEdge& a, const SurfaceEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  };
  const auto same = [](const SurfaceEdge& a, const SurfaceEdge& b) { return a.low == b.low && a.high == b.high; };
  std::vector<SurfaceEdge>& edges = surface_edges;
  edges.clear();
  for (const Index t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax({surface.triangle(t)[i], surface.triangle(t)[(i + 1) % 3]});
      edges.push_back({number(low), number(high)});
    }
  const std::vector<SurfaceEdge> all = edges;
  std::sort(edges.begin(), edges.end(), before);
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  boundary.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const SurfaceEdge& edge = all[3 * t + i];
      const auto at = std::lower_bound(edges.begin(), edges.end(), edge, before);
      const bool is_forward = surface.triangle(triangles[t])[i] == vertices[static_cast<std::size_t>(edge.low)];
      boundary[t][i] = {static_cast<Index>(at - edges.begin()), is_forward ? 1 : -1};
    }
}

/// +1 when the way from v0 to v1 goes through the triangle into the solid, -1 when out of it, else 0.
int SurfaceCrossings::pass(const Vec3& v0, const Vec3& v1, Index triangle) const {
  const auto [a, b, c] = index_.surface().corners(triangle);
  const int start = shifted::above_triangle(a, b, c, v0);
  if (start == shifted::above_triangle(a, b, c, v1)) return 0;
  const int first = shifted::passes(v0, v1, a, b);
  if (first != shifted::passes(v0, v1, b, c) || first != shifted::passes(v0, v1, c, a)) return 0;
  return start;
}

void SurfaceCrossings::cross_triangles() {
  edge_crossings.clear();
  corner_in.assign(cell_->corners.size(), 1);
  if (triangles.empty()) return;
  for (Index e = 0; e < static_cast<Index>(cell_edges.size()); ++e) {
    const CellEdge& edge = cell_edges[static_cast<std::size_t>(e)];
    const Vec3 &from = corner(edge.from), &to = corner(edge.to);
    const Bounds box = box_around(from, to);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (triangle_box_[t].meets(box))
        if (const int sign = pass(from, to, triangles[t]); sign != 0)
          edge_crossings.push_back({e, static_cast<Index>(t), sign});
  }
  const Bounds way = box_around(X_, corner(0));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (triangle_box_[t].meets(way)) corner_in[0] += pass(X_, corner(0), triangles[t]);
  follow_edges_from(0);
}

/// Where the corners are, from where one of them is, along the edges.
void SurfaceCrossings::follow_edges_from(Index start) {
  std::vector<int>& in = corner_in;
  is_known_.assign(in.size(), 0);
  is_known_[static_cast<std::size_t>(start)] = 1;
  const auto rise = [&](Index e) {
    const auto less = [](const EdgeCrossing& c, Index edge) { return c.edge < edge; };
    int sum = 0;
    for (auto c = std::lower_bound(edge_crossings.begin(), edge_crossings.end(), e, less);
         c != edge_crossings.end() && c->edge == e; ++c)
      sum += c->sign;
    return sum;
  };
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (Index e = 0; e < static_cast<Index>(cell_edges.size()); ++e) {
      const auto from = static_cast<std::size_t>(cell_edges[static_cast<std::size_t>(e)].from);
      const auto to = static_cast<std::size_t>(cell_edges[static_cast<std::size_t>(e)].to);
      if (is_known_[from] == is_known_[to]) continue;
      if (is_known_[from])
        in[to] = in[from] + rise(e);
      else
        in[from] = in[to] - rise(e);
      is_known_[from] = is_known_[to] = 1;
      is_new = true;
    }
  }
}

/// Heights of the vertices above the cell's faces: they decide most cases at once.
void SurfaceCrossings::measure_heights() {
  const auto n = static_cast<std::size_t>(cell_->faces());
  std::vector<double>& heights = heights_;
  heights.resize(vertices.size() * n);
  const Vec3 size = box_.size();
  margin_ = kMargin * (size.x + size.y + size.z);
  for (std::size_t f = 0; f < n; ++f) {
    const Vec3 branch = generators_[static_cast<std::size_t>(cell_->neighbours[f])] - X_;
    const double length = norm(branch), distance = generators_.distance(cell_->particle, cell_->neighbours[f], length);
    for (std::size_t u = 0; u < vertices.size(); ++u)
      heights[u * n + f] = dot(branch, vertex(static_cast<Index>(u)) - X_) / length - distance;
  }
}

void SurfaceCrossings::cross_faces() {
  face_crossings.clear();
  for (Index e = 0; e < static_cast<Index>(surface_edges.size()); ++e) {
    const SurfaceEdge& edge = surface_edges[static_cast<std::size_t>(e)];
    if (!box_.meets(box_around(vertex(edge.low), vertex(edge.high)))) continue;
    const auto is_beyond = [&](Index f) { return height(edge.low, f) > margin_ && height(edge.high, f) > margin_; };
    const auto is_within = [&](Index f) { return height(edge.low, f) < -margin_ && height(edge.high, f) < -margin_; };
    bool is_outside = false;
    for (Index f = 0; f < cell_->faces() && !is_outside; ++f) is_outside = is_beyond(f);
    if (is_outside) continue;
    for (Index f = 0; f < cell_->faces(); ++f) {
      if (is_within(f)) continue;
      const auto loop = cell_->face(f);
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const std::array<Index, 3> corners{loop[0], loop[i], loop[i + 1]};
        if (const int sign = pass_face(edge, corners); sign != 0) face_crossings.push_back({e, f, corners, sign});
      }
    }
  }
}

int SurfaceCrossings::pass_face(const SurfaceEdge& edge, const std::array<Index, 3>& corners) const {
  const Vec3 &a = corner(corners[0]), &b = corner(corners[1]), &c = corner(corners[2]);
  const Vec3 &low = vertex(edge.low), &high = vertex(edge.high);
  const int start = shifted::above_face(a, b, c, low);
  if (start == shifted::above_face(a, b, c, high)) return 0;
  const int first = shifted::passes(a, b, low, high);
  if (first != shifted::passes(b, c, low, high) || first != shifted::passes(c, a, low, high)) return 0;
  return start;
}

int SurfaceCrossings::place(Index u) const {
  if (!box_.contains(vertex(u))) return 0;
  bool is_well_inside = true;
  for (Index f = 0; f < cell_->faces(); ++f) {
    if (height(u, f) > margin_) return 0;
    is_well_inside = is_well_inside && height(u, f) < -margin_;
  }
  return is_well_inside ? 1 : is_in_cell(u);
}

/// Counts how often the way from the particle, which is inside, goes through the cell's faces.
int SurfaceCrossings::is_in_cell(Index u) const {
  const Vec3& U = vertex(u);
  int inside = 1;
  for (Index f = 0; f < cell_->faces(); ++f) {
    const auto loop = cell_->face(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vec3 &a = corner(loop[0]), &b = corner(loop[i]), &c = corner(loop[i + 1]);
      const int start = orient3d(a, b, c, X_);
      if (start == shifted::above_face(a, b, c, U)) continue;
      const int first = shifted::passes_ray(X_, U, a, b);
      if (first == shifted::passes_ray(X_, U, b, c) && first == shifted::passes_ray(X_, U, c, a)) inside += start;
    }
  }
  return inside;
}

}  // namespace tessera
