#include "tessera/tessellation/generators.hpp"

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera {
std::string Generators::named(Index g) const {
  const auto i = static_cast<std::size_t>(g);
  const Vec3& X = points_[i];
  return fmt::format("{} at ({:g}, {:g}, {:g}) m", i < names_.size() ? names_[i] : g, X.x, X.y, X.z);
}

void refuse_swallowed(const Generators& generators, Index g, Index h) {
  throw GeometryError(fmt::format(
      "particle {}, radius {:g} m, lies outside its own power cell, if that is not empty: it is in that of "
      "particle {}, radius {:g} m; the squares of two radii must differ by less than the square of the "
      "particles' distance, so make the radii more alike or the distance larger",
      generators.named(g), std::sqrt(generators.weight(g)), generators.named(h), std::sqrt(generators.weight(h))));
}

}  // namespace tessera
