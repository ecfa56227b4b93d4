#include "tessera/tessellation/relax.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/parallel/parallel.hpp"
#include "tessera/tessellation/relax_cells.hpp"

namespace tessera {
namespace {

constexpr double kDifference = 0.1;     // of a cell's size: over which the size formula is differenced
constexpr double kLargestShift = 0.25;  // of a cell's size: by which a density may move its centroid
constexpr double kLeastPart = 0.02;     // of a move that would leave the solid, before it is given up

/// Sums over the points that decide whether to go on.
struct Sums {
  double distance2 = 0.0;  // from points to centroids, in local spacings
  double against = 0.0;    // of the last move with what is to come [m2]: positive when it went too far

  Sums& operator+=(const Sums& other) {
    distance2 += other.distance2;
    against += other.against;
    return *this;
  }
};

template <class Centroids>
class Relaxation {
 public:
  Relaxation(std::vector<Vec3> points, const Centroids& centroids, const RelaxedSpec& spec)
      : centroids_(centroids), spec_(spec), ahead_(std::move(points)), points_(ahead_) {}

  /// In the plane: of a slab this thick [m].
  void keep_in_plane(double thickness) {
    dimension_ = 2;
    thickness_ = thickness;
  }

  Relaxed run() {
    Relaxed result;
    for (; result.iterations < spec_.iterations; ++result.iterations) {
      centroids_.find(ahead_, cells_);
      const Sums sums = step_to_centroids();
      result.distance = std::sqrt(sums.distance2 / static_cast<double>(points_.size()));
      if (result.distance <= spec_.tolerance) break;
      momentum_ = sums.against > 0.0 ? 1.0 : momentum_;
      const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum_ * momentum_));
      carry_on((momentum_ - 1.0) / next);
      momentum_ = next;
    }
    result.points = std::move(points_);
    return result;
  }

 private:
  /// From where the last move was carried on to, each point goes to its centroid.
  Sums step_to_centroids() {
    previous_ = points_;
    const auto n = static_cast<std::int64_t>(points_.size());
    return parallel::sum_ranges<Sums>(0, n, [&](std::int64_t begin, std::int64_t end) {
      const std::optional<Formula> size = spec_.size;
      Sums sums;
      for (auto a = static_cast<std::size_t>(begin); a < static_cast<std::size_t>(end); ++a) {
        Vec3 target = cells_[a].X + (size ? shift(*size, cells_[a]) : Vec3{});
        if (dimension_ == 2) target.z = ahead_[a].z;
        const Vec3 move = target - ahead_[a];
        points_[a] = kept_inside(ahead_[a], move);
        sums.distance2 += norm2(move) / std::pow(width(cells_[a]), 2);
        sums.against -= dot(move, points_[a] - previous_[a]);
      }
      return sums;
    });
  }

  void carry_on(double share) {
    parallel::for_each(static_cast<std::int64_t>(points_.size()), [&](std::int64_t i) {
      const auto a = static_cast<std::size_t>(i);
      ahead_[a] = kept_inside(points_[a], share * (points_[a] - previous_[a]));
    });
  }

  /// X after the move, or after as much of it as the solid has room for.
  Vec3 kept_inside(const Vec3& X, const Vec3& move) const {
    for (double part = 1.0; part > kLeastPart; part *= 0.5)
      if (const Vec3 Y = X + part * move; centroids_.contains(Y)) return Y;
    return X;
  }

  double width(const CellCentroid& cell) const {
    return dimension_ == 2 ? std::sqrt(cell.volume / thickness_) : std::cbrt(cell.volume);
  }

  /// What a density adds to a cell's centroid: the second moment, taken as that of a cube, times the gradient of the
  /// density's logarithm.
  Vec3 shift(const Formula& size, const CellCentroid& cell) const {
    const double h = width(cell), step = kDifference * h;
    Vec3 gradient;
    for (int d = 0; d < dimension_; ++d) {
      Vec3 e;
      e[d] = step;
      gradient[d] = (size(0.0, cell.X + e) - size(0.0, cell.X - e)) / (2.0 * step);
    }
    const Vec3 move = -(dimension_ + 2.0) * h * h / (12.0 * size(0.0, cell.X)) * gradient;
    const double length = norm(move);
    if (!(length <= kLargestShift * h)) return length > 0.0 ? (kLargestShift * h / length) * move : Vec3{};
    return move;
  }

  const Centroids& centroids_;
  const RelaxedSpec& spec_;
  int dimension_ = 3;
  double thickness_ = 1.0;
  std::vector<Vec3> ahead_, points_, previous_;
  std::vector<CellCentroid> cells_;
  double momentum_ = 1.0;
};

}  // namespace

Relaxed relax(std::vector<Vec3> points, const Solid& solid, const RelaxedSpec& spec, int dimension) {
  const CentroidsInSolid centroids(solid);
  Relaxation relaxation(std::move(points), centroids, spec);
  if (dimension == 2) relaxation.keep_in_plane(solid.upper.z - solid.lower.z);
  return relaxation.run();
}

Relaxed relax(std::vector<Vec3> points, const SurfaceIndex& index, const RelaxedSpec& spec) {
  const CentroidsInSurface centroids(index, points.size());
  return Relaxation(std::move(points), centroids, spec).run();
}

}  // namespace tessera
