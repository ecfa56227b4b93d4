#include "tessera/geometry/bounding_tree.hpp"

#include <numeric>

namespace tessera {

/// Halves the items at the median of their boxes' centres, along the axis in which these spread most.
struct BoundingTree::Build {
  BoundingTree& tree;
  std::span<const Bounds> boxes;
  std::vector<Vec3> centers;

  Build(BoundingTree& t, std::span<const Bounds> b) : tree(t), boxes(b) {
    centers.reserve(b.size());
    for (const Bounds& box : b) centers.push_back(0.5 * box.lower + 0.5 * box.upper);
    tree.items_.resize(b.size());
    std::iota(tree.items_.begin(), tree.items_.end(), 0);
    tree.nodes_.reserve(b.size());
    if (!b.empty()) add(0, static_cast<Index>(b.size()));
  }

  const Vec3& center(Index item) const { return centers[static_cast<std::size_t>(item)]; }

  int widest_axis(Index first, Index last) const {
    Bounds spread;
    for (Index i = first; i < last; ++i) spread.include(center(tree.items_[static_cast<std::size_t>(i)]));
    const Vec3 size = spread.size();
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
  }

  void add(Index first, Index last) {
    const std::size_t n = tree.nodes_.size();
    tree.nodes_.emplace_back();
    if (last - first <= leaf_size) {
      Node& leaf = tree.nodes_[n];
      leaf.first = first;
      leaf.count = last - first;
      for (Index i = first; i < last; ++i)
        leaf.box.include(boxes[static_cast<std::size_t>(tree.items_[static_cast<std::size_t>(i)])]);
      return;
    }
    const int axis = widest_axis(first, last);
    const Index middle = first + (last - first) / 2;
    std::nth_element(tree.items_.begin() + first, tree.items_.begin() + middle, tree.items_.begin() + last,
                     [&](Index a, Index b) {
                       const double x = center(a)[axis], y = center(b)[axis];
                       return x != y ? x < y : a < b;
                     });
    add(first, middle);
    const std::size_t right = tree.nodes_.size();
    add(middle, last);
    Node& node = tree.nodes_[n];
    node.right = static_cast<Index>(right);
    node.box.include(tree.nodes_[n + 1].box);
    node.box.include(tree.nodes_[right].box);
  }
};

BoundingTree::BoundingTree(std::span<const Bounds> boxes) { Build(*this, boxes); }

}  // namespace tessera
