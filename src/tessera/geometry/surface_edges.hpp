#pragma once

#include <span>
#include <vector>

#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// One triangle's share in an edge.
struct EdgeUse {
  Index a = 0, b = 0;      // vertices, a < b
  Index triangle = 0;      //
  std::int8_t corner = 0;  // the edge runs from this corner of the triangle to the next
  bool is_forward = true;  // the triangle runs from a to b

  bool same_edge(const EdgeUse& other) const { return a == other.a && b == other.b; }
};

/// All uses of edges, sorted by edge, then triangle.
std::vector<EdgeUse> edge_uses(const TriangleSurface& surface);

/// Calls found(uses) for every edge with the uses that it has.
template <class Found>
void for_each_edge(std::span<const EdgeUse> uses, Found&& found) {
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].same_edge(uses[first])) ++last;
    found(uses.subspan(first, last - first));
  }
}

/// Disjoint sets of numbers, and for each number whether it differs from its set's root.
class ParitySets {
 public:
  explicit ParitySets(Index size);

  struct Root {
    Index root = 0;
    bool differs = false;
  };
  Root find(Index i);
  /// Puts a and b into one set, as equal or as different ones. False when they are known to be the opposite.
  bool join(Index a, Index b, bool differ);

 private:
  std::vector<Root> parent_;
};

}  // namespace tessera
