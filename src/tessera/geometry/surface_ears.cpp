#include <cmath>
#include <numeric>

#include "tessera/geometry/predicates.hpp"
#include "tessera/geometry/surface_reader.hpp"

namespace tessera {
namespace {

/// A polygon seen along the axis nearest to its normal, from which corners are cut off until nothing is left.
class EarCutter {
 public:
  explicit EarCutter(std::span<const Vec3> corners) : corners_(corners), left_(corners.size()) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
    Vec3 normal;  // twice the area vector (Newell)
    for (std::size_t i = 0; i < corners.size(); ++i)
      normal += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    for (int d = 1; d < 3; ++d)
      if (std::abs(normal[d]) > std::abs(normal[axis_])) axis_ = d;
    turn_ = normal[axis_] < 0 ? -1 : 1;
  }

  std::vector<std::array<std::size_t, 3>> cut() {
    std::vector<std::array<std::size_t, 3>> ears;
    while (left_.size() > 3) {
      std::size_t i = 0;
      while (i < left_.size() && !is_ear(i)) ++i;
      if (i == left_.size()) return {};
      ears.push_back({before(i), left_[i], after(i)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (turn(left_[0], left_[1], left_[2]) < 0) return {};
    ears.push_back({left_[0], left_[1], left_[2]});
    return ears;
  }

 private:
  std::size_t before(std::size_t i) const { return left_[(i + left_.size() - 1) % left_.size()]; }
  std::size_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }
  int turn(std::size_t a, std::size_t b, std::size_t c) const {
    return turn_ * orient2d(corners_[a], corners_[b], corners_[c], axis_);
  }

  /// A convex or straight corner, in whose triangle no other corner lies.
  bool is_ear(std::size_t i) const {
    const std::size_t a = before(i), b = left_[i], c = after(i);
    const int convex = turn(a, b, c);
    if (convex < 0) return false;
    if (convex == 0) return dot(corners_[a] - corners_[b], corners_[c] - corners_[b]) <= 0;  // no spike
    for (const std::size_t p : left_) {
      if (p == a || p == b || p == c) continue;
      const Vec3& X = corners_[p];
      if (X == corners_[a] || X == corners_[b] || X == corners_[c]) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::span<const Vec3> corners_;
  std::vector<std::size_t> left_;
  int axis_ = 0, turn_ = 1;
};

}  // namespace

std::vector<std::array<std::size_t, 3>> cut_ears(std::span<const Vec3> corners) { return EarCutter(corners).cut(); }

}  // namespace tessera
