#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tessera/base/error.hpp"
#include "tessera/geometry/predicates.hpp"
#include "tessera/geometry/surface_check.hpp"
#include "tessera/geometry/surface_edges.hpp"
#include "tessera/geometry/triangle_meeting.hpp"

namespace tessera {
namespace {

/// Open edges that hang together.
struct Hole {
  Index edges = 0;
  Index triangle = 0;  // one beside it
  double length = 0.0;
  Vec3 weighted;  // midpoints times lengths

  Vec3 center() const { return weighted / length; }
};

/// Longest first.
std::vector<Hole> find_holes(const TriangleSurface& surface, std::span<const EdgeUse> open) {
  ParitySets sets(static_cast<Index>(surface.vertices.size()));
  for (const EdgeUse& edge : open) sets.join(edge.a, edge.b, false);
  std::map<Index, Hole> by_root;
  for (const EdgeUse& edge : open) {
    const Vec3 &a = surface.vertex(edge.a), &b = surface.vertex(edge.b);
    Hole& hole = by_root[sets.find(edge.a).root];
    if (hole.edges++ == 0) hole.triangle = edge.triangle;
    hole.length += norm(b - a);
    hole.weighted += norm(b - a) * (0.5 * (a + b));
  }
  std::vector<Hole> holes;
  for (const auto& [root, hole] : by_root) holes.push_back(hole);
  std::stable_sort(holes.begin(), holes.end(), [](const Hole& l, const Hole& r) { return l.length > r.length; });
  return holes;
}

/// Compares directions around the edge from u to v, counter-clockwise seen from v, starting at `start`. Exact.
class AroundEdge {
 public:
  AroundEdge(const Vec3& u, const Vec3& v, const Vec3& start) : u_(u), v_(v), start_(start) {}

  bool operator()(const Vec3& p, const Vec3& q) const {
    const int of_p = half(p), of_q = half(q);
    return of_p != of_q ? of_p < of_q : of_p % 2 == 1 && orient3d(u_, v_, p, q) > 0;
  }

 private:
  /// 0 along the start, 1 up to the half turn, 2 there, 3 beyond.
  int half(const Vec3& p) const {
    const int side = orient3d(u_, v_, start_, p);
    if (side != 0) return side > 0 ? 1 : 3;
    for (int axis = 0; axis < 3; ++axis)
      if (const int turn = orient2d(u_, v_, start_, axis); turn != 0) return orient2d(u_, v_, p, axis) == turn ? 0 : 2;
    return 0;
  }

  const Vec3 &u_, &v_, &start_;
};

Vec3 apex(const TriangleSurface& surface, const EdgeUse& use) {
  return surface.vertex(surface.triangle(use.triangle)[(static_cast<std::size_t>(use.corner) + 2) % 3]);
}

/// Going around an edge, does one pass alternately from outside to inside and from inside to outside?
bool alternates(const TriangleSurface& surface, std::span<const EdgeUse> uses) {
  if (uses.size() % 2 != 0) return false;
  if (uses.size() == 2) return uses[0].is_forward != uses[1].is_forward;
  std::vector<EdgeUse> around(uses.begin(), uses.end());
  const Vec3 start = apex(surface, uses[0]);
  const AroundEdge before(surface.vertex(uses[0].a), surface.vertex(uses[0].b), start);
  std::sort(around.begin(), around.end(),
            [&](const EdgeUse& l, const EdgeUse& r) { return before(apex(surface, l), apex(surface, r)); });
  for (std::size_t i = 0; i < around.size(); ++i)
    if (around[i].is_forward == around[(i + 1) % around.size()].is_forward) return false;
  return true;
}

std::string describe_edge(const TriangleSurface& surface, const EdgeUse& use) {
  return fmt::format("the edge from {} to {}", describe_point(surface.vertex(use.a)),
                     describe_point(surface.vertex(use.b)));
}

/// A point that both triangles have or nearly have: where an edge of one passes the other, else between the centres.
Vec3 meeting_place(const TriangleSurface& surface, Index s, Index t) {
  for (const auto& [of, with] : {std::pair{s, t}, std::pair{t, s}}) {
    const auto edge = surface.corners(of), face = surface.corners(with);
    const Triangle& v = surface.triangle(of);
    const Triangle& w = surface.triangle(with);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (std::find(w.begin(), w.end(), v[i]) != w.end() || std::find(w.begin(), w.end(), v[j]) != w.end()) continue;
      const Vec3 normal = cross(face[1] - face[0], face[2] - face[0]);
      const double from = dot(normal, edge[i] - face[0]), to = dot(normal, edge[j] - face[0]);
      if (from != to && segment_meets_triangle(edge[i], edge[j], face[0], face[1], face[2]))
        return edge[i] + std::clamp(from / (from - to), 0.0, 1.0) * (edge[j] - edge[i]);
    }
  }
  Vec3 sum;
  for (const Index i : {s, t})
    for (const Vec3& X : surface.corners(i)) sum += X;
  return sum / 6.0;
}

}  // namespace

void refuse_holes(const FileSurface& file) {
  const TriangleSurface& surface = file.surface;
  std::vector<EdgeUse> open;
  for_each_edge(edge_uses(surface), [&](std::span<const EdgeUse> uses) {
    if (uses.size() == 1) open.push_back(uses[0]);
  });
  if (open.empty()) return;
  const std::vector<Hole> holes = find_holes(surface, open);
  const Hole& hole = holes[0];
  const std::string many = holes.size() == 1 ? "a hole" : fmt::format("{} holes, the longest", holes.size());
  throw GeometryError(fmt::format(
      "{}: the surface is not closed: it has {} around {}, with {} open edges, {:.4g} long together, one of them that "
      "of {}: fill the holes in the program that wrote it",
      file.path, many, describe_point(hole.center()), hole.edges, hole.length, describe_triangle(file, hole.triangle)));
}

void refuse_contrary_edges(const FileSurface& file) {
  const TriangleSurface& surface = file.surface;
  Index wrong = 0;
  EdgeUse first;
  std::size_t triangles = 0;
  for_each_edge(edge_uses(surface), [&](std::span<const EdgeUse> uses) {
    if (alternates(surface, uses)) return;
    if (wrong++ > 0) return;
    first = uses[0];
    triangles = uses.size();
  });
  if (wrong == 0) return;
  throw GeometryError(fmt::format(
      "{}: {} triangles meet at {} in a way that leaves open what is inside ({} such {}): a sheet without thickness "
      "ends there, or faces within the solid; remove them in the program that wrote the surface",
      file.path, triangles, describe_edge(surface, first), wrong, wrong == 1 ? "edge" : "edges"));
}

void refuse_wrong_meetings(const FileSurface& file) {
  const auto meeting = find_wrong_meeting(file.surface);
  if (!meeting) return;
  throw GeometryError(fmt::format(
      "{}: the surface cuts itself at {}: {} and {} meet there ({} such {}): unite overlapping parts in the program "
      "that wrote it",
      file.path, describe_point(meeting_place(file.surface, meeting->s, meeting->t)),
      describe_triangle(file, meeting->s), describe_triangle(file, meeting->t), meeting->pairs,
      meeting->pairs == 1 ? "pair" : "pairs"));
}

}  // namespace tessera
