#include "tessera/geometry/scatter.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "tessera/geometry/random.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {
namespace {

constexpr double kBlockWidth = 2.0;      // of the blocks that points are drawn from, in spacings
constexpr double kFirstDistance = 0.92;  // of discs, in spacings; more find no room for all
constexpr double kShrink = 0.98;
constexpr std::int64_t kDartsPerPoint = 20;
constexpr std::int64_t kDartsAtOnce = 1 << 17;
constexpr int kMostRounds = 230;  // the distance is then a hundredth of the first one
constexpr int kSamplesPerPoint = 8;
constexpr double kMostCells = 5e7;
constexpr double kMostPoints = 2e9;

Index count_in(const Region& region, const Amount& amount, const Origin& origin) {
  const double count = amount.in(region.size, region.dimension);
  if (count > kMostPoints)
    throw InputError(origin,
                     fmt::format("{:.3g} particles are more than {:g}; choose a larger spacing or fewer of them", count,
                                 kMostPoints));
  return static_cast<Index>(count);
}

double spacing_of(Index count, const Region& region) {
  const double part = region.size / static_cast<double>(count);
  return region.dimension == 2 ? std::sqrt(part) : std::cbrt(part);
}

[[noreturn]] void refuse(const Origin& origin, Index count, double spacing) {
  throw InputError(origin, fmt::format("the solid has no room for {} particles {:g} m below its surface, {:g} of the "
                                       "spacing; choose more of them or a smaller spacing",
                                       count, kLeastDepth * spacing, kLeastDepth));
}

/// Points in the cells of a grid as wide as the largest distance asked for.
class Discs {
 public:
  Discs(const Bounds& box, double distance) : lower_(box.lower), width_(distance) {
    const Vec3 size = box.size();
    const auto cells = [&] {
      double n = 1.0;
      for (int d = 0; d < 3; ++d) n *= std::floor(size[d] / width_) + 1.0;
      return n;
    };
    while (cells() > kMostCells) width_ *= 1.1;
    for (int d = 0; d < 3; ++d)
      cells_[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(std::floor(size[d] / width_)) + 1;
    first_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]), -1);
  }

  bool has_room(const Vec3& X, double distance) const {
    const Cell home = cell_of(X);
    if (!is_clear(home, X, distance)) return false;  // the likeliest
    for (std::int64_t k = std::max<std::int64_t>(home[2] - 1, 0); k <= std::min(home[2] + 1, cells_[2] - 1); ++k)
      for (std::int64_t j = std::max<std::int64_t>(home[1] - 1, 0); j <= std::min(home[1] + 1, cells_[1] - 1); ++j)
        for (std::int64_t i = std::max<std::int64_t>(home[0] - 1, 0); i <= std::min(home[0] + 1, cells_[0] - 1); ++i)
          if (!is_clear({i, j, k}, X, distance)) return false;
    return true;
  }
  void add(const Vec3& X) {
    Index& first = first_[number(cell_of(X))];
    next_.push_back(first);
    first = static_cast<Index>(points.size());
    points.push_back(X);
  }

  std::vector<Vec3> points;

 private:
  using Cell = std::array<std::int64_t, 3>;
  bool is_clear(const Cell& cell, const Vec3& X, double distance) const {
    for (Index p = first_[number(cell)]; p >= 0; p = next_[static_cast<std::size_t>(p)])
      if (norm2(points[static_cast<std::size_t>(p)] - X) < distance * distance) return false;
    return true;
  }
  Cell cell_of(const Vec3& X) const {
    Cell cell{};
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      cell[axis] =
          std::clamp<std::int64_t>(static_cast<std::int64_t>((X[d] - lower_[d]) / width_), 0, cells_[axis] - 1);
    }
    return cell;
  }
  std::size_t number(const Cell& c) const {
    return static_cast<std::size_t>(c[0] + cells_[0] * (c[1] + cells_[1] * c[2]));
  }

  Vec3 lower_;
  double width_;
  Cell cells_{};
  std::vector<Index> first_, next_;  // of each cell; after each point
};

/// Of consecutive darts those that hit the region and find room among the discs there are, in their order. In parallel:
/// what they do to each other is left to be seen.
std::vector<Vec3> darts_with_room(const Discs& discs, double distance, const Cover& cover, std::uint64_t seed,
                                  std::int64_t first, std::int64_t darts) {
  auto rows = parallel::collect_rows<Vec3>(static_cast<Index>(darts), [&](Index i, parallel::RowCollector<Vec3>& out) {
    const auto dart = static_cast<std::uint64_t>(first + i);
    const auto block = static_cast<std::int64_t>(random_number(~seed, dart) * static_cast<double>(cover.size()));
    const Vec3 X = cover.draw(block, seed, dart);
    if (discs.has_room(X, distance) && cover.is_in_region(block, X)) out.add(X);
  });
  return std::move(rows.value);
}

/// A random point of the region and its weight.
struct Sample {
  Vec3 X;
  double weight = 1.0;
  std::int64_t block = 0;
};

double density(const Formula& size, const Vec3& X, int dimension, const Origin& origin) {
  const double h = size(0.0, X);
  if (!(h > 0.0))
    throw InputError(origin, fmt::format("size = \"{}\" gives {:g} at ({:g}, {:g}, {:g}) m; it must be positive "
                                         "everywhere in the solid",
                                         size.text(), h, X.x, X.y, X.z));
  return dimension == 2 ? 1.0 / (h * h) : 1.0 / (h * h * h);
}

std::vector<Sample> samples_of(const RelaxedSpec& spec, const Origin& origin, const Region& region,
                               const Cover& cover) {
  const double points_per_block = region.dimension == 2 ? kBlockWidth * kBlockWidth : std::pow(kBlockWidth, 3);
  const auto samples = static_cast<Index>(kSamplesPerPoint * points_per_block);
  auto rows = parallel::collect_rows<Sample>(
      static_cast<Index>(cover.size()), [&](Index block, parallel::RowCollector<Sample>& out) {
        for (Index i = 0; i < samples; ++i)
          if (const auto X = cover.point(block, spec.seed, static_cast<std::uint64_t>(block) * samples + i))
            out.add({*X, 1.0, block});
      });
  std::vector<Sample> all = std::move(rows.value);
  if (spec.size)
    for (Sample& s : all) s.weight = density(*spec.size, s.X, region.dimension, origin);
  return all;
}

/// Takes the samples at which the sum of weights passes each of `count` random heights, one in every equal step.
class Picker {
 public:
  Picker(const RelaxedSpec& spec, const Cover& cover, double step) : spec_(spec), cover_(cover), step_(step) {}

  void pass(const Sample& sample, Index count) {
    sum_ += sample.weight;
    bool is_new = true;
    while (static_cast<Index>(points.size()) < count && sum_ >= height()) {
      points.push_back(is_new ? sample.X : another_in(sample));
      is_new = false;
    }
  }

  /// The last step, where round-off has left it.
  void finish(const Sample& last, Index count) {
    if (static_cast<Index>(points.size()) < count) points.push_back(another_in(last));
  }

  std::vector<Vec3> points;

 private:
  double height() const {
    return step_ * (static_cast<double>(points.size()) + random_number(~spec_.seed, points.size()));
  }
  /// A block has at least one point in the region: the sample itself.
  Vec3 another_in(const Sample& sample) {
    for (;;)
      if (const auto X = cover_.point(sample.block, ~spec_.seed, ++drawn_)) return *X;
  }

  const RelaxedSpec& spec_;
  const Cover& cover_;
  double step_, sum_ = 0.0;
  std::uint64_t drawn_ = 0;
};

}  // namespace

std::vector<Vec3> scatter_discs(const RandomSpec& spec, const Origin& origin, const Region& region) {
  const Index count = count_in(region, spec.amount, origin);
  const double spacing = spacing_of(count, region);
  const Cover cover(region, kBlockWidth * spacing, kLeastDepth * spacing);
  if (cover.is_empty()) refuse(origin, count, spacing);
  double distance = kFirstDistance * spacing;
  Discs discs(bounds(region.index.surface()), distance);
  std::int64_t first = 0;
  for (int round = 0; round < kMostRounds; ++round, distance *= kShrink)
    for (const std::int64_t end = first + kDartsPerPoint * count; first < end;) {
      const std::int64_t darts = std::min(kDartsAtOnce, end - first);
      for (const Vec3& X : darts_with_room(discs, distance, cover, spec.seed, first, darts)) {
        if (!discs.has_room(X, distance)) continue;
        discs.add(X);
        if (static_cast<Index>(discs.points.size()) == count) return std::move(discs.points);
      }
      first += darts;
    }
  refuse(origin, count, spacing);
}

std::vector<Vec3> scatter_by_size(const RelaxedSpec& spec, const Origin& origin, const Region& region) {
  const Index count = count_in(region, spec.amount, origin);
  const double spacing = spacing_of(count, region);
  const Cover cover(region, kBlockWidth * spacing, kLeastDepth * spacing);
  const std::vector<Sample> samples = samples_of(spec, origin, region, cover);
  if (samples.empty()) refuse(origin, count, spacing);
  std::vector<Vec3> places;
  double total = 0.0;
  for (const Sample& s : samples) {
    places.push_back(s.X);
    total += s.weight;
  }
  Picker picker(spec, cover, total / static_cast<double>(count));
  const std::vector<Index> order = hilbert_order(places);
  for (const Index i : order) picker.pass(samples[static_cast<std::size_t>(i)], count);
  picker.finish(samples[static_cast<std::size_t>(order.back())], count);
  return std::move(picker.points);
}

}  // namespace tessera
