#include "tessera/tessellation/voronoi_grid.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

constexpr double kBlockSize = 1.0;  // in spacings: a block, its neighbours and theirs hold nearly all that make a cell
constexpr double kMostBlocksPerPoint = 8.0;

}  // namespace

PointGrid::PointGrid(std::span<const Vec3> points, const Vec3& lower, const Vec3& upper, double spacing)
    : lower_(lower) {
  const Vec3 size = upper - lower;
  const double most = kMostBlocksPerPoint * static_cast<double>(points.size());
  size_ = std::max(kBlockSize * spacing, std::cbrt(size.x * size.y * size.z / most));
  for (int d = 0; d < 3; ++d) blocks_[static_cast<std::size_t>(d)] = static_cast<int>(std::floor(size[d] / size_)) + 1;

  std::vector<Index> block(points.size());
  parallel::for_each(static_cast<std::int64_t>(points.size()), [&](std::int64_t i) {
    const std::array<int, 3> b = block_of(points[static_cast<std::size_t>(i)]);
    block[static_cast<std::size_t>(i)] = b[0] + blocks_[0] * (b[1] + blocks_[1] * b[2]);
  });
  begin_.assign(static_cast<std::size_t>(blocks_[0] * blocks_[1] * blocks_[2]) + 1, 0);
  for (const Index b : block) ++begin_[static_cast<std::size_t>(b)];
  Index end = 0;
  for (Index& b : begin_) b = end += b;
  // From the last point to the first: each block's `begin_` then goes down from its end to its beginning.
  entries_.resize(points.size());
  for (std::size_t i = points.size(); i-- > 0;)
    entries_[static_cast<std::size_t>(--begin_[static_cast<std::size_t>(block[i])])] = {points[i],
                                                                                        static_cast<Index>(i)};
}

std::array<int, 3> PointGrid::block_of(const Vec3& X) const {
  std::array<int, 3> block{};
  for (std::size_t d = 0; d < 3; ++d) {
    const int axis = static_cast<int>(d);
    block[d] = std::clamp(static_cast<int>(std::floor((X[axis] - lower_[axis]) / size_)), 0, blocks_[d] - 1);
  }
  return block;
}

}  // namespace tessera
