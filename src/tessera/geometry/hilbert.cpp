#include <algorithm>
#include <array>
#include <cstdint>

#include "tessera/geometry/particles.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/parallel/sort.hpp"

namespace tessera {
namespace {

constexpr int kBits = 21;  // per axis: three of them fill a 64-bit key

/// Place of a cell of the 2^21 cubed grid on the Hilbert curve (Skilling, AIP Conf. Proc. 707 (2004) 381).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1U << (kBits - 1); q > 1; q >>= 1)
    for (std::size_t i = 0; i < 3; ++i) {
      if (x[i] & q) {
        x[0] ^= q - 1;
      } else {
        const std::uint32_t t = (x[0] ^ x[i]) & (q - 1);
        x[0] ^= t;
        x[i] ^= t;
      }
    }
  for (std::size_t i = 1; i < 3; ++i) x[i] ^= x[i - 1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1U << (kBits - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  std::uint64_t key = 0;
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (const std::uint32_t c : x) key = (key << 1) | (((c ^ t) >> bit) & 1U);
  return key;
}

/// Equal keys stay in the order of the points.
struct Placed {
  std::uint64_t key;
  Index point;

  friend bool operator<(const Placed& a, const Placed& b) {
    return a.key < b.key || (a.key == b.key && a.point < b.point);
  }
};

}  // namespace

std::vector<Index> hilbert_order(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  Vec3 lower = points[0], upper = points[0];
  for (const Vec3& X : points)
    for (int d = 0; d < 3; ++d) lower[d] = std::min(lower[d], X[d]), upper[d] = std::max(upper[d], X[d]);
  const Vec3 size = upper - lower;
  const double extent = std::max({size.x, size.y, size.z});
  const double scale =
      extent > 0.0 ? ((1U << kBits) - 1) / extent : 0.0;  // one scale: near in space is near on the curve
  std::vector<Placed> placed(points.size());
  const auto n = static_cast<std::int64_t>(points.size());
  parallel::for_each(n, [&](std::int64_t i) {
    const Vec3 cell = scale * (points[static_cast<std::size_t>(i)] - lower);
    const std::uint64_t key = hilbert_key(
        {static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y), static_cast<std::uint32_t>(cell.z)});
    placed[static_cast<std::size_t>(i)] = {key, static_cast<Index>(i)};
  });
  parallel::sort(placed);
  std::vector<Index> order(points.size());
  parallel::for_each(
      n, [&](std::int64_t i) { order[static_cast<std::size_t>(i)] = placed[static_cast<std::size_t>(i)].point; });
  return order;
}

std::vector<Vec3> permuted(const std::vector<Vec3>& points, const std::vector<Index>& order) {
  std::vector<Vec3> result(order.size());
  parallel::for_each(static_cast<std::int64_t>(order.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    result[k] = points[static_cast<std::size_t>(order[k])];
  });
  return result;
}

}  // namespace tessera
