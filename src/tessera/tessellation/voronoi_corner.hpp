#pragma once

#include <array>
#include <span>

#include "tessera/base/index.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/tessellation/generators.hpp"

namespace tessera {

/// A corner of a Voronoi cell as the point where bisectors of its generators and walls of the solid meet: four
/// generators and no wall, three and one, two and two, or one and three. However it is put together, the same
/// corner holds the same numbers in the same order.
class Corner {
 public:
  void add(Index generator);
  void add(const Plane& wall);

  std::span<const Index> generators() const { return {generators_.data(), static_cast<std::size_t>(generator_count_)}; }
  std::span<const Plane> walls() const { return {walls_.data(), static_cast<std::size_t>(wall_count_)}; }

 private:
  std::array<Index, 4> generators_{};
  std::array<Plane, 3> walls_{};
  int generator_count_ = 0;
  int wall_count_ = 0;
};

/// The position of a corner [m]. It depends on the corner alone, so all cells that meet there get the same bits; that
/// is what makes cells close to round-off even where the planes are nearly parallel. When they are parallel to within
/// round-off it is `estimate`.
Vec3 corner_position(const Generators& points, const Corner& corner, const Vec3& estimate);

}  // namespace tessera
