#include <algorithm>

#include "tessera/geometry/bounding_tree.hpp"
#include "tessera/geometry/surface_edges.hpp"
#include "tessera/geometry/surface_mend.hpp"

namespace tessera {
namespace {

/// The edges that only one triangle uses, and their vertices.
struct OpenEdges {
  std::vector<EdgeUse> uses;
  std::vector<Index> vertices;

  explicit OpenEdges(const TriangleSurface& surface) {
    for_each_edge(edge_uses(surface), [&](std::span<const EdgeUse> all) {
      if (all.size() == 1) uses.push_back(all[0]);
    });
    for (const EdgeUse& use : uses) {
      vertices.push_back(use.a);
      vertices.push_back(use.b);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
};

Bounds grown(const Vec3& X, double by) {
  Bounds box;
  box.include(X - Vec3{by, by, by});
  box.include(X + Vec3{by, by, by});
  return box;
}

/// Where along a -> b (0 to 1) X is when it is nearer than `tolerance` to the edge, but not to its ends; else -1.
double place_on_edge(const Vec3& X, const Vec3& a, const Vec3& b, double tolerance) {
  const double length2 = norm2(b - a);
  const double s = dot(X - a, b - a) / length2;
  if (!(s > 0 && s < 1) || norm(X - (a + s * (b - a))) > tolerance) return -1;
  return std::min(norm(X - a), norm(X - b)) > tolerance ? s : -1;
}

/// One pass: divides each triangle along one of its edges at most. True when it divided any.
bool split_once(FileSurface& file, SurfaceRepairs& repairs) {
  TriangleSurface& surface = file.surface;
  const OpenEdges open(surface);
  std::vector<Bounds> boxes;
  for (const Index v : open.vertices) boxes.push_back(grown(surface.vertex(v), repairs.tolerance));
  const BoundingTree tree(boxes);

  std::vector<bool> is_split(surface.triangles.size(), false);
  bool any = false;
  for (const EdgeUse& use : open.uses) {
    const auto t = static_cast<std::size_t>(use.triangle);
    if (is_split[t]) continue;
    const auto corner = static_cast<std::size_t>(use.corner);
    const Triangle whole = surface.triangles[t];
    const Index from = whole[corner], to = whole[(corner + 1) % 3], apex = whole[(corner + 2) % 3];
    const Vec3 a = surface.vertex(from), b = surface.vertex(to);
    Bounds edge;
    edge.include(a);
    edge.include(b);
    std::vector<std::pair<double, Index>> on_edge;
    tree.visit([&](const Bounds& box) { return box.meets(edge); },
               [&](Index i) {
                 const Index v = open.vertices[static_cast<std::size_t>(i)];
                 if (v == apex) return;
                 const double s = place_on_edge(surface.vertex(v), a, b, repairs.tolerance);
                 if (s > 0) on_edge.emplace_back(s, v);
               });
    if (on_edge.empty()) continue;
    std::sort(on_edge.begin(), on_edge.end());
    surface.triangles[t] = {from, on_edge[0].second, apex};
    for (std::size_t i = 0; i < on_edge.size(); ++i) {
      const Index next = i + 1 < on_edge.size() ? on_edge[i + 1].second : to;
      surface.triangles.push_back({on_edge[i].second, next, apex});
      surface.side.push_back(surface.side[t]);
      if (!file.place.empty()) file.place.push_back(file.place[t]);
    }
    is_split[t] = true;
    any = true;
    ++repairs.split_triangles;
  }
  return any;
}

}  // namespace

void split_at_vertices_on_edges(FileSurface& file, SurfaceRepairs& repairs) {
  // A triangle has three edges, and its parts none that is new to the open ones: three passes reach everything.
  for (int pass = 0; pass < 3 && split_once(file, repairs); ++pass) {
  }
}

}  // namespace tessera
