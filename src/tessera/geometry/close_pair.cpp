#include "tessera/geometry/close_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace tessera {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (const std::int64_t i : c) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15ULL, h ^= h >> 29;
    return h;
  }
};

Cell cell_of(const Vec3& X, double size) {
  Cell cell{};
  for (std::size_t d = 0; d < 3; ++d) cell[d] = static_cast<std::int64_t>(std::floor(X[static_cast<int>(d)] / size));
  return cell;
}

}  // namespace

std::optional<std::pair<Index, Index>> find_close_pair(const std::vector<Vec3>& points, double distance) {
  // The grid is as fine as the distance looked for: a cell with more than eight points would hold a close pair, so the
  // search stays linear however unevenly the points lie.
  std::unordered_multimap<Cell, Index, CellHash> grid;
  grid.reserve(points.size());
  for (std::size_t b = 0; b < points.size(); ++b) {
    const Cell home = cell_of(points[b], distance);
    Index found = -1;
    for (int n = 0; n < 27; ++n) {
      const Cell cell{home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1};
      const auto [begin, end] = grid.equal_range(cell);
      for (auto it = begin; it != end; ++it)
        if (norm(points[static_cast<std::size_t>(it->second)] - points[b]) < distance)
          found = found < 0 ? it->second : std::min(found, it->second);
    }
    if (found >= 0) return std::pair{found, static_cast<Index>(b)};
    grid.emplace(home, static_cast<Index>(b));
  }
  return std::nullopt;
}

}  // namespace tessera
