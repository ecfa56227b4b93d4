#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/discretization/voronoi_common.hpp"

namespace tessera {

/// Finds the particles nearest to one by walking from cell to cell through common faces, so that it never looks across
/// a gap. One object serves one thread.
class NearbyParticles {
 public:
  NearbyParticles(std::span<const Vec3> X, const Csr<FaceOfCell>& faces) : X_(X), faces_(faces), seen_(X.size(), -1) {}

  /// Starts at particle a, whose cell has this size [m].
  void start(Index a, double size) {
    a_ = a;
    radius_ = 1.5 * size;
    search();
  }

  /// The `wanted` nearest particles and all that are as far as the last of them, by distance and number; fewer if the
  /// body has no more.
  std::span<const Index> nearest(std::size_t wanted) {
    while (found_.size() <= wanted && more_outside_) {
      radius_ *= 1.3;
      search();
    }
    if (found_.size() <= wanted) return numbers(found_.size());
    std::size_t end = wanted;
    while (end < found_.size() && found_[end].square <= same_distance * found_[wanted - 1].square) ++end;
    return numbers(end);
  }

 private:
  static constexpr double same_distance = 1.0 + 1e-9;  // of squares, as on a lattice

  struct Found {
    double square;  // of the distance [m2]
    Index b;
    friend bool operator<(const Found& l, const Found& r) {
      return l.square != r.square ? l.square < r.square : l.b < r.b;
    }
  };

  const Vec3& at(Index a) const { return X_[static_cast<std::size_t>(a)]; }

  /// All particles within the radius that chains of neighbours within the radius reach.
  void search() {
    const double limit = radius_ * radius_ * same_distance;
    found_.clear();
    more_outside_ = false;
    ++round_;
    seen_[static_cast<std::size_t>(a_)] = round_;
    const auto look_around = [&](Index from) {
      for (const FaceOfCell& f : interior_faces(faces_, from)) {
        Index& seen = seen_[static_cast<std::size_t>(f.neighbour)];
        if (seen == round_) continue;
        seen = round_;
        const double square = norm2(at(f.neighbour) - at(a_));
        if (square > limit)
          more_outside_ = true;
        else
          found_.push_back({square, f.neighbour});
      }
    };
    look_around(a_);
    for (std::size_t i = 0; i < found_.size(); ++i) look_around(found_[i].b);
    std::sort(found_.begin(), found_.end());
  }

  std::span<const Index> numbers(std::size_t n) {
    numbers_.clear();
    for (std::size_t i = 0; i < n; ++i) numbers_.push_back(found_[i].b);
    return numbers_;
  }

  std::span<const Vec3> X_;
  const Csr<FaceOfCell>& faces_;
  std::vector<Index> seen_;  // the last search that met the particle
  Index a_ = 0, round_ = 0;
  double radius_ = 0.0;
  bool more_outside_ = false;
  std::vector<Found> found_;
  std::vector<Index> numbers_;
};

}  // namespace tessera
