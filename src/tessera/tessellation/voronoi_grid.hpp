#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// Points sorted into cubic blocks, with their coordinates beside each other in memory: rows of blocks along x are
/// contiguous. Many searches may share one grid.
class PointGrid {
 public:
  struct Entry {
    Vec3 X;  // [m]
    Index point;
  };

  /// Points in the box lower .. upper, about `spacing` apart [m].
  PointGrid(std::span<const Vec3> points, const Vec3& lower, const Vec3& upper, double spacing);

  double block_size() const { return size_; }                   // [m]
  const std::array<int, 3>& blocks() const { return blocks_; }  // per direction
  const Vec3& lower() const { return lower_; }                  // [m]

  std::array<int, 3> block_of(const Vec3& X) const;

  /// The points of blocks first .. last (all in the grid) of the row (j, k).
  std::span<const Entry> row(int first, int last, int j, int k) const {
    const Index base = blocks_[0] * (j + blocks_[1] * k);
    const Index begin = begin_[static_cast<std::size_t>(base + first)];
    const Index end = begin_[static_cast<std::size_t>(base + last + 1)];
    return {entries_.data() + begin, static_cast<std::size_t>(end - begin)};
  }

 private:
  Vec3 lower_;
  double size_;                  // of a block [m]
  std::array<int, 3> blocks_{};  // per direction
  std::vector<Index> begin_;     // of every block in entries_, and the end
  std::vector<Entry> entries_;
};

}  // namespace tessera
