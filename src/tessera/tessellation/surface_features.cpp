#include "tessera/tessellation/surface_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace tessera {

namespace {

/// One use of an undirected edge a < b by a triangle.
struct EdgeUse {
  Index a, b, triangle;
  bool same_edge(const EdgeUse& o) const { return a == o.a && b == o.b; }
};

std::vector<EdgeUse> sorted_edges(const TriangleSurface& surface) {
  std::vector<EdgeUse> uses;
  for (Index t = 0; t < surface.size(); ++t) {
    const Triangle& v = surface.triangle(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = std::min(v[i], v[(i + 1) % 3]), b = std::max(v[i], v[(i + 1) % 3]);
      uses.push_back({a, b, t});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& l, const EdgeUse& r) {
    return std::pair(l.a, l.b) != std::pair(r.a, r.b) ? std::pair(l.a, l.b) < std::pair(r.a, r.b)
                                                      : l.triangle < r.triangle;
  });
  return uses;
}

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); }

bool is_feature(const TriangleSurface& surface, const EdgeUse* first, std::ptrdiff_t uses, double least_cosine) {
  if (uses != 2) return true;
  const Index s = first[0].triangle, t = first[1].triangle;
  if (surface.side[static_cast<std::size_t>(s)] != surface.side[static_cast<std::size_t>(t)]) return true;
  return dot(normalized(area_vector(surface, s)), normalized(area_vector(surface, t))) < least_cosine;
}

/// The features as a graph, from which lines are taken edge by edge.
class FeatureGraph {
 public:
  FeatureGraph(const TriangleSurface& surface, double angle) : surface_(surface), at_(surface.vertices.size()) {
    const std::vector<EdgeUse> uses = sorted_edges(surface);
    for (std::size_t i = 0; i < uses.size();) {
      std::size_t end = i + 1;
      while (end < uses.size() && uses[end].same_edge(uses[i])) ++end;
      if (is_feature(surface, &uses[i], static_cast<std::ptrdiff_t>(end - i), cosine(angle))) {
        at(uses[i].a).push_back(uses[i].b);
        at(uses[i].b).push_back(uses[i].a);
      } else {
        across_.push_back({uses[i].triangle, uses[i + 1].triangle});
      }
      i = end;
    }
    find_patches();
    is_end_.resize(at_.size());
    for (std::size_t v = 0; v < at_.size(); ++v) is_end_[v] = !at_[v].empty() && ends_at(static_cast<Index>(v));
  }

  std::vector<Index> patches() const { return patch_; }

  std::vector<FeatureLine> lines() {
    std::vector<FeatureLine> lines;
    for (const bool from_ends : {true, false})  // what is left after the lines from ends are closed loops
      for (std::size_t v = 0; v < at_.size(); ++v)
        while (!at_[v].empty() && (is_end_[v] || !from_ends)) lines.push_back(take_line(static_cast<Index>(v)));
    return lines;
  }

 private:
  std::vector<Index>& at(Index v) { return at_[static_cast<std::size_t>(v)]; }

  bool ends_at(Index v) {
    const std::vector<Index>& next = at(v);
    if (next.size() != 2) return true;
    const Vec3 in = normalized(surface_.vertex(v) - surface_.vertex(next[0])),
               out = normalized(surface_.vertex(next[1]) - surface_.vertex(v));
    return dot(in, out) < cosine(kCornerAngle);
  }

  /// Joins triangles over the edges that are no features.
  void find_patches() {
    std::vector<std::vector<Index>> beside(surface_.triangles.size());
    for (const auto& [s, t] : across_) {
      beside[static_cast<std::size_t>(s)].push_back(t);
      beside[static_cast<std::size_t>(t)].push_back(s);
    }
    patch_.assign(beside.size(), -1);
    Index patches = 0;
    for (std::size_t first = 0; first < beside.size(); ++first) {
      if (patch_[first] >= 0) continue;
      std::vector<Index> rest{static_cast<Index>(first)};
      for (patch_[first] = patches; !rest.empty();) {
        const auto t = static_cast<std::size_t>(rest.back());
        rest.pop_back();
        for (const Index s : beside[t])
          if (Index& patch = patch_[static_cast<std::size_t>(s)]; patch < 0) rest.push_back(s), patch = patches;
      }
      ++patches;
    }
  }

  Index take_edge(Index v) {
    const Index next = at(v).back();
    at(v).pop_back();
    std::vector<Index>& back = at(next);
    back.erase(std::find(back.begin(), back.end(), v));
    return next;
  }

  FeatureLine take_line(Index start) {
    FeatureLine line{start, take_edge(start)};
    while (line.back() != start && !is_end_[static_cast<std::size_t>(line.back())])
      line.push_back(take_edge(line.back()));
    return line;
  }

  const TriangleSurface& surface_;
  std::vector<std::vector<Index>> at_;  // of each vertex the ends of its edges that no line has yet
  std::vector<char> is_end_;
  std::vector<std::array<Index, 2>> across_;  // triangles beside each other without a line between them
  std::vector<Index> patch_;
};

}  // namespace

SurfaceFeatures surface_features(const TriangleSurface& surface, double angle) {
  FeatureGraph graph(surface, angle);
  return {graph.lines(), graph.patches()};
}

}  // namespace tessera
