#include "tessera/geometry/region.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/geometry/random.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {

Cover::Cover(const Region& region, double width, double depth) : region_(region), width_(width), depth_(depth) {
  const Bounds box = bounds(region.index.surface());
  const bool is_flat = region.dimension == 2;
  const auto count = [&](int d) { return static_cast<Index>(std::max(1.0, std::ceil(box.size()[d] / width))); };
  const Index nx = count(0), ny = count(1), nz = is_flat ? 1 : count(2);
  const Vec3 half = 0.5 * width * Vec3{1.0, 1.0, is_flat ? 0.0 : 1.0};
  const Vec3 start{box.lower.x, box.lower.y, is_flat ? region.level : box.lower.z};
  const auto rows = parallel::collect_rows<Block>(ny * nz, [&](Index row, parallel::RowCollector<Block>& out) {
    for (Index i = 0; i < nx; ++i) {
      const Vec3 step{static_cast<double>(i), static_cast<double>(row % ny), static_cast<double>(row / ny)};
      const Vec3 lower = start + width * step, center = lower + half;
      const bool is_cut = region.index.is_nearer_than(norm(half) + depth, center);
      if (is_cut || region.index.winding(center) != 0) out.add({lower, !is_cut});
    }
  });
  blocks_ = rows.value;
}

Vec3 Cover::draw(std::int64_t block, std::uint64_t seed, std::uint64_t counter) const {
  Vec3 X = blocks_[static_cast<std::size_t>(block)].lower;
  for (int d = 0; d < region_.dimension; ++d)
    X[d] += width_ * random_number(seed, 3 * counter + static_cast<std::uint64_t>(d));
  return X;
}

bool Cover::is_in_region(std::int64_t block, const Vec3& X) const {
  return blocks_[static_cast<std::size_t>(block)].is_inside || region_.is_deep(X, depth_);
}

std::optional<Vec3> Cover::point(std::int64_t block, std::uint64_t seed, std::uint64_t counter) const {
  const Vec3 X = draw(block, seed, counter);
  if (is_in_region(block, X)) return X;
  return std::nullopt;
}

}  // namespace tessera
