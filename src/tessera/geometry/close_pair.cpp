#include "tessera/geometry/close_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tessera/parallel/parallel.hpp"
#include "tessera/parallel/sort.hpp"

namespace tessera {
namespace {

// Of the cells in which points meet, in distances looked for. Most points then touch one cell only, and a cell without
// a close pair holds a bounded number of points, however unevenly they lie.
constexpr double kCellSize = 16.0;

using Cell = std::array<std::int64_t, 3>;

/// Cells that share a key cost comparisons, no more.
std::uint64_t key_of(const Cell& c) {
  std::uint64_t h = 0;
  for (const std::int64_t i : c) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15ULL, h ^= h >> 29;
  return h;
}

Cell cell_of(const Vec3& X, double size) {
  Cell cell{};
  for (std::size_t d = 0; d < 3; ++d) cell[d] = static_cast<std::int64_t>(std::floor(X[static_cast<int>(d)] / size));
  return cell;
}

/// A cell that a point comes as near to as the distance looked for.
struct Visit {
  std::uint64_t cell;
  Index point;

  friend bool operator<(const Visit& a, const Visit& b) {
    return a.cell < b.cell || (a.cell == b.cell && a.point < b.point);
  }
};

/// Calls take(key) for every cell within `distance` of X.
template <class Take>
void for_cells(const Vec3& X, double distance, Take&& take) {
  const Vec3 margin{distance, distance, distance};
  const Cell first = cell_of(X - margin, kCellSize * distance), last = cell_of(X + margin, kCellSize * distance);
  for (std::int64_t k = first[2]; k <= last[2]; ++k)
    for (std::int64_t j = first[1]; j <= last[1]; ++j)
      for (std::int64_t i = first[0]; i <= last[0]; ++i) take(key_of({i, j, k}));
}

std::vector<Visit> sorted_visits(const std::vector<Vec3>& points, double distance) {
  const auto n = static_cast<std::int64_t>(points.size());
  std::vector<std::size_t> first(points.size() + 1, 0);
  parallel::for_each(n, [&](std::int64_t i) {
    const auto p = static_cast<std::size_t>(i);
    for_cells(points[p], distance, [&](std::uint64_t) { ++first[p + 1]; });
  });
  for (std::size_t p = 0; p < points.size(); ++p) first[p + 1] += first[p];
  std::vector<Visit> visits(first.back());
  parallel::for_each(n, [&](std::int64_t i) {
    std::size_t k = first[static_cast<std::size_t>(i)];
    for_cells(points[static_cast<std::size_t>(i)], distance, [&](std::uint64_t key) {
      visits[k++] = {key, static_cast<Index>(i)};
    });
  });
  parallel::sort(visits);
  return visits;
}

constexpr std::pair<Index, Index> kNone{-1, std::numeric_limits<Index>::max()};

/// The smaller b first, then the smaller a.
std::pair<Index, Index> earlier(const std::pair<Index, Index>& p, const std::pair<Index, Index>& q) {
  return std::pair{q.second, q.first} < std::pair{p.second, p.first} ? q : p;
}

}  // namespace

std::optional<std::pair<Index, Index>> find_close_pair(const std::vector<Vec3>& points, double distance) {
  const std::vector<Visit> visits = sorted_visits(points, distance);
  const auto n = static_cast<std::int64_t>(visits.size());
  const auto blocks = static_cast<std::size_t>((n + parallel::block_size - 1) / parallel::block_size);
  std::vector<std::pair<Index, Index>> found(blocks, kNone);
  parallel::for_ranges(0, n, [&](std::int64_t begin, std::int64_t end) {
    std::pair<Index, Index>& first = found[static_cast<std::size_t>(begin / parallel::block_size)];
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
      for (std::size_t w = v + 1; w < visits.size() && visits[w].cell == visits[v].cell; ++w) {
        const Index a = visits[v].point, b = visits[w].point;
        if (a != b && norm(points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(b)]) < distance)
          first = earlier(first, {a, b});
      }
  });
  std::pair<Index, Index> first = kNone;
  for (const auto& pair : found) first = earlier(first, pair);
  if (first == kNone) return std::nullopt;
  return first;
}

}  // namespace tessera
