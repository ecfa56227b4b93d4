#include "tessera/geometry/surface_edges.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tessera {

std::vector<EdgeUse> edge_uses(const TriangleSurface& surface) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * surface.triangles.size());
  for (Index t = 0; t < surface.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = surface.triangle(t)[i], b = surface.triangle(t)[(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), t, static_cast<std::int8_t>(i), a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& l, const EdgeUse& r) {
    return std::tie(l.a, l.b, l.triangle) < std::tie(r.a, r.b, r.triangle);
  });
  return uses;
}

ParitySets::ParitySets(Index size) {
  parent_.reserve(static_cast<std::size_t>(size));
  for (Index i = 0; i < size; ++i) parent_.push_back({i, false});
}

ParitySets::Root ParitySets::find(Index i) {
  Root up{i, false};  // the root, and whether i differs from it
  while (parent_[static_cast<std::size_t>(up.root)].root != up.root) {
    const Root& next = parent_[static_cast<std::size_t>(up.root)];
    up = {next.root, up.differs != next.differs};
  }
  for (Root at{i, up.differs}; at.root != up.root;) {  // everything on the way is hung to the root
    Root& entry = parent_[static_cast<std::size_t>(at.root)];
    const Root next{entry.root, at.differs != entry.differs};
    entry = {up.root, at.differs};
    at = next;
  }
  return up;
}

bool ParitySets::join(Index a, Index b, bool differ) {
  const Root of_a = find(a), of_b = find(b);
  const bool roots_differ = (of_a.differs != of_b.differs) != differ;
  if (of_a.root == of_b.root) return !roots_differ;
  const auto [low, high] = std::minmax(of_a.root, of_b.root);
  parent_[static_cast<std::size_t>(high)] = {low, roots_differ};
  return true;
}

}  // namespace tessera
