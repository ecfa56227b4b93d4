#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/geometry/bounds.hpp"

namespace tessera {

/// A binary tree of boxes over items that each have a box. Built once, the same for the same boxes; any number of
/// threads may ask at once. Takes n log n time to build and about 30 bytes an item.
class BoundingTree {
 public:
  explicit BoundingTree(std::span<const Bounds> boxes);

  /// Calls found(item) for the items of all leaves that can be reached through boxes for which enter(box) holds, in an
  /// order that depends on the tree only. Items are not tested one by one.
  template <class Enter, class Found>
  void visit(Enter&& enter, Found&& found) const;

  /// Goes through the items in the order of promising branches: least(box) bounds what value(item) can be from below.
  /// Gives the item of the smallest value, of equals the one met first, and its value; -1 for a tree without items or
  /// when no value is below `limit`.
  template <class Least, class Value>
  std::pair<Index, double> minimum(Least&& least, Value&& value, double limit) const;

 private:
  struct Node {
    Bounds box;
    Index first = 0;  // leaf: its first place in items_
    Index count = 0;  // leaf: number of items; 0 for an inner node
    Index right = 0;  // inner node: the right child; the left one is the next node
  };
  struct Build;
  static constexpr Index leaf_size = 4;
  static constexpr std::size_t most_levels = 64;  // halving 2^31 items takes 31

  std::vector<Node> nodes_;
  std::vector<Index> items_;
};

template <class Enter, class Found>
void BoundingTree::visit(Enter&& enter, Found&& found) const {
  std::array<Index, most_levels> waiting;
  std::size_t waits = 0;
  if (!nodes_.empty()) waiting[waits++] = 0;
  while (waits > 0) {
    const Index n = waiting[--waits];
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    if (!enter(node.box)) continue;
    for (Index i = node.first; i < node.first + node.count; ++i) found(items_[static_cast<std::size_t>(i)]);
    if (node.count > 0) continue;
    waiting[waits++] = node.right;
    waiting[waits++] = n + 1;
  }
}

template <class Least, class Value>
std::pair<Index, double> BoundingTree::minimum(Least&& least, Value&& value, double limit) const {
  std::pair<Index, double> best{-1, limit};
  std::array<std::pair<Index, double>, most_levels> waiting;
  std::size_t waits = 0;
  if (!nodes_.empty()) waiting[waits++] = {0, least(nodes_[0].box)};
  while (waits > 0) {
    const auto [n, bound] = waiting[--waits];
    if (bound >= best.second) continue;
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    for (Index i = node.first; i < node.first + node.count; ++i) {
      const Index item = items_[static_cast<std::size_t>(i)];
      if (const double v = value(item); v < best.second) best = {item, v};
    }
    if (node.count > 0) continue;
    const std::pair<Index, double> left{n + 1, least(nodes_[static_cast<std::size_t>(n) + 1].box)};
    const std::pair<Index, double> right{node.right, least(nodes_[static_cast<std::size_t>(node.right)].box)};
    waiting[waits++] = left.second <= right.second ? right : left;
    waiting[waits++] = left.second <= right.second ? left : right;
  }
  return best;
}

}  // namespace tessera
