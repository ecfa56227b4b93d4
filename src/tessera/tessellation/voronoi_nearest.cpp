#include "tessera/tessellation/voronoi_nearest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tessera {
namespace {

constexpr double kBlockSize = 1.7;  // in spacings: the first shell then holds nearly all points that make a cell
constexpr double kMostBlocksPerPoint = 8.0;

}  // namespace

NearestPoints::NearestPoints(std::span<const Vec3> points, const Vec3& lower, const Vec3& upper, double spacing)
    : points_(points), lower_(lower) {
  const Vec3 size = upper - lower;
  const double most = kMostBlocksPerPoint * static_cast<double>(points.size());
  size_ = std::max(kBlockSize * spacing, std::cbrt(size.x * size.y * size.z / most));
  for (int d = 0; d < 3; ++d) blocks_[static_cast<std::size_t>(d)] = static_cast<int>(std::floor(size[d] / size_)) + 1;
  std::vector<Index> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  const auto row = [&](Index p) {
    const std::array<int, 3> b = block_of(points_[static_cast<std::size_t>(p)]);
    return b[0] + blocks_[0] * (b[1] + blocks_[1] * b[2]);
  };
  members_ = group_by_row(blocks_[0] * blocks_[1] * blocks_[2], std::span<const Index>(all), row);
}

std::array<int, 3> NearestPoints::block_of(const Vec3& X) const {
  std::array<int, 3> block{};
  for (std::size_t d = 0; d < 3; ++d) {
    const int axis = static_cast<int>(d);
    block[d] = std::clamp(static_cast<int>(std::floor((X[axis] - lower_[axis]) / size_)), 0, blocks_[d] - 1);
  }
  return block;
}

bool NearestPoints::is_farther(const Candidate& a, const Candidate& b) {
  return a.distance > b.distance || (a.distance == b.distance && a.point > b.point);
}

void NearestPoints::start(Index center) {
  center_ = center;
  home_ = block_of(points_[static_cast<std::size_t>(center)]);
  shells_ = 0;
  covered_ = 0.0;
  heap_.clear();
  listed_.clear();
}

Index NearestPoints::neighbour(std::size_t rank, double reach) {
  while (listed_.size() <= rank) {
    const double nearest = heap_.empty() ? std::numeric_limits<double>::infinity() : heap_.front().distance;
    if (nearest < covered_ && nearest <= reach) {
      std::pop_heap(heap_.begin(), heap_.end(), is_farther);
      listed_.push_back(heap_.back());
      heap_.pop_back();
    } else if (covered_ <= reach) {
      add_shell();
    } else {
      return -1;
    }
  }
  return listed_[rank].distance <= reach ? listed_[rank].point : -1;
}

void NearestPoints::add_shell() {
  const int s = shells_++;
  for (int k = std::max(home_[2] - s, 0); k <= std::min(home_[2] + s, blocks_[2] - 1); ++k)
    for (int j = std::max(home_[1] - s, 0); j <= std::min(home_[1] + s, blocks_[1] - 1); ++j) {
      const bool is_rim = std::abs(k - home_[2]) == s || std::abs(j - home_[1]) == s;
      const int step = is_rim || s == 0 ? 1 : 2 * s;  // inside the rim only the two ends of a row are new
      for (int i = home_[0] - s; i <= home_[0] + s; i += step)
        if (i >= 0 && i < blocks_[0]) add_block(i, j, k);
    }
  update_covered();
}

void NearestPoints::add_block(int i, int j, int k) {
  const Vec3& X = points_[static_cast<std::size_t>(center_)];
  for (const Index p : members_.row(i + blocks_[0] * (j + blocks_[1] * k))) {
    if (p == center_) continue;
    heap_.push_back({norm(points_[static_cast<std::size_t>(p)] - X), p});
    std::push_heap(heap_.begin(), heap_.end(), is_farther);
  }
}

/// Distance from the center to the nearest face of the searched blocks behind which there are more blocks.
void NearestPoints::update_covered() {
  covered_ = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < 3; ++d) {
    const int axis = static_cast<int>(d);
    const double at = points_[static_cast<std::size_t>(center_)][axis] - lower_[axis];
    const int first = home_[d] - shells_ + 1, last = home_[d] + shells_ - 1;
    if (first > 0) covered_ = std::min(covered_, at - first * size_);
    if (last < blocks_[d] - 1) covered_ = std::min(covered_, (last + 1) * size_ - at);
  }
}

}  // namespace tessera
