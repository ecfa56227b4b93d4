#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "tessera/geometry/surface_edges.hpp"
#include "tessera/geometry/surface_mend.hpp"

namespace tessera {
namespace {

/// Keeps the triangles for which keep[t] holds, in their order.
void keep_triangles(FileSurface& file, const std::vector<bool>& keep) {
  TriangleSurface& surface = file.surface;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (!keep[t]) continue;
    surface.triangles[kept] = surface.triangles[t];
    surface.side[kept] = surface.side[t];
    if (!file.place.empty()) file.place[kept] = file.place[t];
    ++kept;
  }
  surface.triangles.resize(kept);
  surface.side.resize(kept);
  if (!file.place.empty()) file.place.resize(kept);
}

/// Twice the area over the longest edge: the least distance of a corner from the opposite edge.
double thickness(const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
  return longest > 0 ? norm(cross(b - a, c - a)) / longest : 0.0;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Do the vertices, sorted, come in the triangle's sense of rotation?
bool is_even(const Triangle& t) {
  const auto least = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return t[(least + 1) % 3] < t[(least + 2) % 3];
}

/// All triangles on the same three vertices, and how many look either way.
struct Stack {
  Triangle vertices{};           // ascending
  std::vector<Index> odd, even;  // triangles in which the vertices come in the one or the other sense

  /// As many look one way as the other: touching walls of two bodies, which are to vanish, or a face with two sides,
  /// one of which is to stay.
  bool is_ambiguous() const { return odd.size() == even.size(); }
};

std::vector<Stack> find_stacks(const TriangleSurface& surface, const std::vector<bool>& keep) {
  std::vector<std::pair<Triangle, Index>> order;
  for (Index t = 0; t < surface.size(); ++t)
    if (keep[static_cast<std::size_t>(t)]) order.emplace_back(sorted(surface.triangle(t)), t);
  std::sort(order.begin(), order.end());
  std::vector<Stack> stacks;
  for (const auto& [vertices, t] : order) {
    if (stacks.empty() || stacks.back().vertices != vertices) stacks.push_back({vertices, {}, {}});
    (is_even(surface.triangle(t)) ? stacks.back().even : stacks.back().odd).push_back(t);
  }
  return stacks;
}

struct StackEdge {
  Index a, b, stack;
};

std::vector<StackEdge> stack_edges(const std::vector<Stack>& stacks) {
  std::vector<StackEdge> edges;
  for (std::size_t s = 0; s < stacks.size(); ++s) {
    const auto& [a, b, c] = stacks[s].vertices;
    for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{a, c}})
      edges.push_back({u, v, static_cast<Index>(s)});
  }
  std::sort(edges.begin(), edges.end(), [](const StackEdge& l, const StackEdge& r) {
    return std::tie(l.a, l.b, l.stack) < std::tie(r.a, r.b, r.stack);
  });
  return edges;
}

/// Which stacks leave a triangle. Ambiguous ones that hang together stay when the others leave all edges around them
/// open, so that they are missing there.
std::vector<bool> find_lasting(const std::vector<Stack>& stacks) {
  const auto is_ambiguous = [&](Index s) { return stacks[static_cast<std::size_t>(s)].is_ambiguous(); };
  const std::vector<StackEdge> edges = stack_edges(stacks);
  ParitySets patches(static_cast<Index>(stacks.size()));
  std::vector<Index> is_closed_beside;  // ambiguous stacks at edges that are closed without them
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    Index clear = 0, neighbour = -1;
    for (; last < edges.size() && edges[last].a == edges[first].a && edges[last].b == edges[first].b; ++last)
      if (!is_ambiguous(edges[last].stack)) ++clear;
    for (std::size_t i = first; i < last; ++i) {
      const Index s = edges[i].stack;
      if (!is_ambiguous(s)) continue;
      if (clear == 0 && neighbour >= 0) patches.join(neighbour, s, false);
      if (clear > 0 && clear % 2 == 0) is_closed_beside.push_back(s);
      neighbour = s;
    }
  }
  std::vector<bool> vanishes(stacks.size(), false);
  for (const Index s : is_closed_beside) vanishes[static_cast<std::size_t>(patches.find(s).root)] = true;
  std::vector<bool> lasting(stacks.size(), true);
  for (Index s = 0; s < static_cast<Index>(stacks.size()); ++s)
    if (is_ambiguous(s))
      lasting[static_cast<std::size_t>(s)] = !vanishes[static_cast<std::size_t>(patches.find(s).root)];
  return lasting;
}

}  // namespace

void drop_needless_triangles(FileSurface& file, SurfaceRepairs& repairs) {
  const TriangleSurface& surface = file.surface;
  std::vector<bool> keep(surface.triangles.size(), true);
  for (Index t = 0; t < surface.size(); ++t) {
    if (thickness(surface.corners(t)) > repairs.tolerance) continue;
    keep[static_cast<std::size_t>(t)] = false;
    ++repairs.flat_triangles;
  }
  const std::vector<Stack> stacks = find_stacks(surface, keep);
  const std::vector<bool> lasting = find_lasting(stacks);
  for (std::size_t s = 0; s < stacks.size(); ++s) {
    const auto& [vertices, odd, even] = stacks[s];
    for (const auto& side : {odd, even})
      for (const Index t : side) keep[static_cast<std::size_t>(t)] = false;
    const auto many = static_cast<Index>(odd.size() + even.size());
    if (lasting[s]) {
      const Index lasts =
          odd.size() == even.size() ? std::min(odd[0], even[0]) : (odd.size() > even.size() ? odd : even)[0];
      keep[static_cast<std::size_t>(lasts)] = true;
      repairs.doubled_triangles += many - 1;
    } else {
      repairs.back_to_back += many / 2;
    }
  }
  keep_triangles(file, keep);
}

}  // namespace tessera
