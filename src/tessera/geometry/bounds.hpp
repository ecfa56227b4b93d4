#pragma once

#include <algorithm>
#include <limits>

#include "tessera/base/vec3.hpp"

namespace tessera {

/// A closed axis-parallel box [m]. A new one is empty: it contains nothing until it is made to.
struct Bounds {
  Vec3 lower{infinity, infinity, infinity};
  Vec3 upper{-infinity, -infinity, -infinity};

  void include(const Vec3& X) {
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], X[d]);
      upper[d] = std::max(upper[d], X[d]);
    }
  }
  void include(const Bounds& other) {
    include(other.lower);
    include(other.upper);
  }
  bool contains(const Vec3& X) const {
    return lower.x <= X.x && X.x <= upper.x && lower.y <= X.y && X.y <= upper.y && lower.z <= X.z && X.z <= upper.z;
  }
  bool meets(const Bounds& other) const {
    return lower.x <= other.upper.x && other.lower.x <= upper.x && lower.y <= other.upper.y &&
           other.lower.y <= upper.y && lower.z <= other.upper.z && other.lower.z <= upper.z;
  }
  Vec3 size() const { return upper - lower; }
  /// The square of the distance from X [m2], zero inside.
  double distance2(const Vec3& X) const {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double off = std::max({lower[d] - X[d], X[d] - upper[d], 0.0});
      sum += off * off;
    }
    return sum;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

}  // namespace tessera
