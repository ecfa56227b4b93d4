#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// The points that cells belong to and, for power (Laguerre) cells, a weight of each: its radius squared. A cell holds
/// what has the least |x - X_g|^2 - w_g, so its faces are planes across the branches, nearer to the lighter generator
/// (F. Aurenhammer, Power diagrams, SIAM J. Comput. 16, 1987). Without weights they bisect: Voronoi cells. A view:
/// points and weights must outlive it.
///
///          |                distance(g, h, L) from g to the plane, along the branch to h of length L:
///    g ----|--------- h     half of L + (w_g - w_h) / L
///          |
class Generators {
 public:
  Generators(std::span<const Vec3> points) : points_(points) {}     // NOLINT: a set of points is one without weights
  Generators(const std::vector<Vec3>& points) : points_(points) {}  // NOLINT
  /// As many weights [m2] as points, or none; and the numbers by which messages call the points, or none.
  Generators(std::span<const Vec3> points, std::span<const double> weights, std::span<const Index> names = {})
      : points_(points), weights_(weights), names_(names) {
    for (const double w : weights) heaviest_ = std::max(heaviest_, w);
  }

  std::size_t size() const { return points_.size(); }
  std::span<const Vec3> points() const { return points_; }
  std::span<const Index> names() const { return names_; }
  const Vec3& operator[](std::size_t g) const { return points_[g]; }
  bool has_weights() const { return !weights_.empty(); }
  double weight(Index g) const { return weights_.empty() ? 0.0 : weights_[static_cast<std::size_t>(g)]; }

  /// "7 at (1, 2, 3) m", for messages.
  std::string named(Index g) const;

  double distance(Index g, Index h, double length) const {
    return weights_.empty() ? 0.5 * length : 0.5 * (length + (weight(g) - weight(h)) / length);
  }
  /// The plane between g and h in the form (X_h - X_g) . (x - X_g) = offset [m2], |X_h - X_g|^2 being `length2`.
  double offset(Index g, Index h, double length2) const {
    return weights_.empty() ? 0.5 * length2 : 0.5 * (length2 + (weight(g) - weight(h)));
  }
  /// Generators farther away than this from g [m] have no plane nearer to it than `radius`.
  double reach(Index g, double radius) const {
    return weights_.empty() ? 2.0 * radius : radius + std::sqrt(radius * radius + (heaviest_ - weight(g)));
  }

 private:
  std::span<const Vec3> points_;
  std::span<const double> weights_;
  std::span<const Index> names_;
  double heaviest_ = 0.0;
};

/// Throws GeometryError that names both: generator g lies outside its own power cell, beyond its plane with h.
[[noreturn]] void refuse_swallowed(const Generators& generators, Index g, Index h);

/// Where the plane between g and h cuts the branch, as a fraction of the way from g to h; 0.5 without weights.
inline double cut_of(const Generators& generators, Index g, Index h) {
  if (!generators.has_weights()) return 0.5;
  const double length = norm(generators[static_cast<std::size_t>(h)] - generators[static_cast<std::size_t>(g)]);
  return generators.distance(g, h, length) / length;
}

/// A generator must be this far, relative to the distance from its neighbour, within its own cell.
inline constexpr double kLeastShare = 1e-9;

}  // namespace tessera
