#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tessera/geometry/surface_index.hpp"

namespace tessera {

/// Where the centres of Voronoi cells may be: in what a surface encloses, not too near it; in two dimensions only in
/// the plane z = level, where the surface stands upright.
struct Region {
  const SurfaceIndex& index;
  double size;  // volume [m3], in two dimensions area [m2]
  int dimension = 3;
  double level = 0.0;  // [m]

  /// Is X in the solid and at least `depth` [m] away from its surface?
  bool is_deep(const Vec3& X, double depth) const {
    return index.location(X) == Location::inside && !index.is_nearer_than(depth, X);
  }
};

/// Cubes, in two dimensions squares, side by side, that together cover all of a region that is deep enough; for drawing
/// random points.
class Cover {
 public:
  /// Cubes of the given width [m].
  Cover(const Region& region, double width, double depth);

  std::int64_t size() const { return static_cast<std::int64_t>(blocks_.size()); }
  bool is_empty() const { return blocks_.empty(); }
  /// The random point number `counter` of a block, in the region or not.
  Vec3 draw(std::int64_t block, std::uint64_t seed, std::uint64_t counter) const;
  /// Is X, which lies in the block, in the region and deep enough?
  bool is_in_region(std::int64_t block, const Vec3& X) const;
  /// What draw() gives; nothing when that is not in the region.
  std::optional<Vec3> point(std::int64_t block, std::uint64_t seed, std::uint64_t counter) const;

 private:
  struct Block {
    Vec3 lower;              // [m]
    bool is_inside = false;  // wholly
  };

  const Region& region_;
  double width_, depth_;
  std::vector<Block> blocks_;
};

}  // namespace tessera
