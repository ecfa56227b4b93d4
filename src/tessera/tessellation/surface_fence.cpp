#include "tessera/tessellation/surface_fence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace tessera {
namespace {

constexpr double kMostCells = 3e7;
constexpr int kLevels = 3;         // the fence is this many cells away from those that the surface touches
constexpr double kFarAway = 10.0;  // distance of the farthest generators, in sizes of what they surround
constexpr double kScatter = 0.2;   // of a cell: points in general position make fewer ties

using Place = std::array<std::int64_t, 3>;

/// A grid around the solid. Cells that the surface touches have level 0; those that can be reached from outside count
/// how many cells they are away from these, in all 26 directions; others are inside.
class Grid {
 public:
  Grid(const Bounds& box, double size) : size_(size) {
    const double margin = (kLevels + 2) * size;
    for (int d = 0; d < 3; ++d) {
      lower_[d] = box.lower[d] - margin;
      cells_[static_cast<std::size_t>(d)] =
          static_cast<std::int64_t>(std::ceil((box.upper[d] - box.lower[d] + 2.0 * margin) / size));
    }
    level_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]), kUnknown);
  }

  void touch(const TriangleSurface& surface) {
    for (Index t = 0; t < surface.size(); ++t) touch(surface, t);
  }

  /// The cells of level kLevels.
  std::vector<Place> fence() {
    flood();
    std::vector<std::size_t> front;
    for (std::size_t c = 0; c < level_.size(); ++c)
      if (level_[c] == 0) front.push_back(c);
    for (signed char level = 1; level <= kLevels; ++level) front = next_level(front, level);
    std::sort(front.begin(), front.end());
    std::vector<Place> places;
    for (const std::size_t c : front) places.push_back(place(c));
    return places;
  }

  Vec3 center(const Place& p) const {
    return lower_ + size_ * Vec3{static_cast<double>(p[0]) + 0.5, static_cast<double>(p[1]) + 0.5,
                                 static_cast<double>(p[2]) + 0.5};
  }

 private:
  static constexpr signed char kUnknown = -1, kOutside = -2;

  std::size_t number(const Place& p) const {
    return static_cast<std::size_t>(p[0] + cells_[0] * (p[1] + cells_[1] * p[2]));
  }
  Place place(std::size_t c) const {
    const auto i = static_cast<std::int64_t>(c);
    return {i % cells_[0], i / cells_[0] % cells_[1], i / (cells_[0] * cells_[1])};
  }
  std::int64_t along(int d, double x) const {
    const std::int64_t last = cells_[static_cast<std::size_t>(d)] - 1;
    return std::clamp(static_cast<std::int64_t>(std::floor((x - lower_[d]) / size_)), std::int64_t{0}, last);
  }

  void touch(const TriangleSurface& surface, Index t) {
    const Bounds box = bounds(surface, t);
    const Vec3 normal = normalized(area_vector(surface, t)), X = surface.corners(t)[0];
    const double half = 0.51 * size_ * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    const double slack = 1e-6 * size_;
    Place first{}, last{};
    for (int d = 0; d < 3; ++d) {
      first[static_cast<std::size_t>(d)] = along(d, box.lower[d] - slack);
      last[static_cast<std::size_t>(d)] = along(d, box.upper[d] + slack);
    }
    Place p{};
    for (p[2] = first[2]; p[2] <= last[2]; ++p[2])
      for (p[1] = first[1]; p[1] <= last[1]; ++p[1])
        for (p[0] = first[0]; p[0] <= last[0]; ++p[0])
          if (!(std::abs(dot(normal, center(p) - X)) > half)) level_[number(p)] = 0;
  }

  template <class Visit>
  void for_each_around(std::size_t c, Visit&& visit) const {
    const Place p = place(c);
    Place q{};
    for (q[2] = std::max(p[2] - 1, std::int64_t{0}); q[2] <= std::min(p[2] + 1, cells_[2] - 1); ++q[2])
      for (q[1] = std::max(p[1] - 1, std::int64_t{0}); q[1] <= std::min(p[1] + 1, cells_[1] - 1); ++q[1])
        for (q[0] = std::max(p[0] - 1, std::int64_t{0}); q[0] <= std::min(p[0] + 1, cells_[0] - 1); ++q[0])
          visit(number(q));
  }

  /// Marks what can be reached from the grid's first cell, which is outside.
  void flood() {
    std::vector<std::size_t> waiting{0};
    level_[0] = kOutside;
    while (!waiting.empty()) {
      const std::size_t c = waiting.back();
      waiting.pop_back();
      for_each_around(c, [&](std::size_t next) {
        if (level_[next] != kUnknown) return;
        level_[next] = kOutside;
        waiting.push_back(next);
      });
    }
  }

  std::vector<std::size_t> next_level(const std::vector<std::size_t>& front, signed char level) {
    std::vector<std::size_t> found;
    for (const std::size_t c : front)
      for_each_around(c, [&](std::size_t next) {
        if (level_[next] != kOutside) return;
        level_[next] = level;
        found.push_back(next);
      });
    return found;
  }

  Vec3 lower_;
  double size_;
  Place cells_{};
  std::vector<signed char> level_;
};

}  // namespace

std::vector<Vec3> fence_points(const TriangleSurface& surface, double distance) {
  const Bounds box = bounds(surface);
  // The center of a cell of level l is at least l - 1/2 cells away from what is touched.
  double size = distance / (kLevels - 0.5 - kScatter);
  const Vec3 extent = box.size();
  const auto cells = [&](double s) {
    const double more = 2 * (kLevels + 3) * s;
    return (extent.x + more) * (extent.y + more) * (extent.z + more) / (s * s * s);
  };
  while (cells(size) > kMostCells) size *= 1.2;

  Grid grid(box, size);
  grid.touch(surface);
  std::mt19937 random(1);  // the same numbers on every machine
  const auto scatter = [&] {
    return kScatter / std::sqrt(3.0) * size * (static_cast<double>(random()) / 0x1p31 - 1.0);
  };
  std::vector<Vec3> points;
  for (const Place& place : grid.fence()) {
    Vec3 X = grid.center(place);
    for (int d = 0; d < 3; ++d) X[d] += scatter();
    points.push_back(X);
  }
  return points;
}

std::vector<Vec3> enclosed_generators(std::span<const Vec3> particles, std::span<const Vec3> fence) {
  std::vector<Vec3> generators(particles.begin(), particles.end());
  generators.insert(generators.end(), fence.begin(), fence.end());
  Bounds box;
  for (const Vec3& X : generators) box.include(X);
  const Vec3 center = 0.5 * (box.lower + box.upper);
  const double far = kFarAway * norm(box.size());
  for (const Vec3& way : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}})
    generators.push_back(center + far * way);
  return generators;
}

}  // namespace tessera
