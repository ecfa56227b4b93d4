#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "tessera/geometry/particles.hpp"

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

}  // namespace

std::vector<Index> hilbert_order(const std::vector<Vec3>& points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  if (points.empty()) return order;
  Vec3 lower = points[0], upper = points[0];
  for (const Vec3& X : points)
    for (int d = 0; d < 3; ++d) lower[d] = std::min(lower[d], X[d]), upper[d] = std::max(upper[d], X[d]);
  const Vec3 size = upper - lower;
  const double extent = std::max({size.x, size.y, size.z});
  const double scale =
      extent > 0.0 ? ((1U << kBits) - 1) / extent : 0.0;  // one scale: near in space is near on the curve
  std::vector<std::uint64_t> key;
  for (const Vec3& X : points) {
    const Vec3 cell = scale * (X - lower);
    key.push_back(hilbert_key(
        {static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y), static_cast<std::uint32_t>(cell.z)}));
  }
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return key[static_cast<std::size_t>(a)] < key[static_cast<std::size_t>(b)];
  });
  return order;
}

}  // namespace tessera
