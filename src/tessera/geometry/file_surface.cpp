#include "tessera/geometry/file_surface.hpp"

#include <fmt/format.h>

namespace tessera {

std::string describe_point(const Vec3& X) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", X.x, X.y, X.z); }

std::string describe_triangle(const FileSurface& file, Index triangle) {
  const auto [a, b, c] = file.surface.corners(triangle);
  const auto t = static_cast<std::size_t>(triangle);
  const std::string place = t < file.place.size()
                                ? fmt::format(" ({} {})", file.unit == PlaceUnit::line ? "line" : "byte", file.place[t])
                                : std::string();
  return fmt::format("the triangle{} around {}", place, describe_point((a + b + c) / 3.0));
}

}  // namespace tessera
