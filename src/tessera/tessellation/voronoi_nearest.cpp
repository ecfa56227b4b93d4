#include "tessera/tessellation/voronoi_nearest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {

void NearestPoints::start(Index center, const Vec3& X) {
  center_ = center;
  X_ = X;
  home_ = grid_.block_of(X);
  shells_ = 0;
  covered_ = 0.0;
  sorted2_ = 0.0;
  known_.clear();
  listed_.clear();
}

/// Lists what is known and within reach, or looks farther. Is there more to list, perhaps?
bool NearestPoints::list_more(double reach) {
  // A point at a distance of exactly `reach` counts, one at exactly covered_ may have an unknown companion.
  const double limit2 =
      reach < covered_ ? std::nextafter(reach * reach, std::numeric_limits<double>::infinity()) : covered_ * covered_;
  if (limit2 > sorted2_) {
    sort_known(limit2);
    return true;
  }
  if (covered_ > reach || covered_ == std::numeric_limits<double>::infinity()) return false;
  add_shell();
  return true;
}

void NearestPoints::sort_known(double limit2) {
  const auto listed = static_cast<std::ptrdiff_t>(listed_.size());
  std::size_t kept = 0;
  for (const Candidate& c : known_)
    if (c.distance2 < limit2)
      listed_.push_back(c);
    else
      known_[kept++] = c;
  known_.resize(kept);
  std::sort(listed_.begin() + listed, listed_.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.point < b.point);
  });
  sorted2_ = limit2;
}

/// Searches the blocks around those searched; to begin with the home block and all that touch it.
void NearestPoints::add_shell() {
  const std::array<int, 3>& blocks = grid_.blocks();
  const int inner = shells_ - 1;  // blocks up to this distance were searched
  const int s = std::max(shells_, 1);
  shells_ = s + 1;
  for (int k = std::max(home_[2] - s, 0); k <= std::min(home_[2] + s, blocks[2] - 1); ++k)
    for (int j = std::max(home_[1] - s, 0); j <= std::min(home_[1] + s, blocks[1] - 1); ++j) {
      const int first = std::max(home_[0] - s, 0), last = std::min(home_[0] + s, blocks[0] - 1);
      if (std::abs(k - home_[2]) > inner || std::abs(j - home_[1]) > inner) {
        add_row(first, last, j, k);
      } else {
        if (home_[0] - s >= 0) add_row(first, first, j, k);
        if (home_[0] + s < blocks[0]) add_row(last, last, j, k);
      }
    }
  update_covered();
}

void NearestPoints::add_row(int first, int last, int j, int k) {
  for (const PointGrid::Entry& e : grid_.row(first, last, j, k))
    if (e.point != center_) known_.push_back({norm2(e.X - X_), e.point});
}

/// Distance from the center to the nearest face of the searched blocks behind which there are more blocks.
void NearestPoints::update_covered() {
  covered_ = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < 3; ++d) {
    const int axis = static_cast<int>(d);
    const double at = X_[axis] - grid_.lower()[axis], size = grid_.block_size();
    const int first = home_[d] - shells_ + 1, last = home_[d] + shells_ - 1;
    if (first > 0) covered_ = std::min(covered_, at - first * size);
    if (last < grid_.blocks()[d] - 1) covered_ = std::min(covered_, (last + 1) * size - at);
  }
  covered_ = std::max(covered_, 0.0);
}

}  // namespace tessera
