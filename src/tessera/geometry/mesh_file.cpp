#include "tessera/geometry/mesh_file.hpp"

#include <fmt/format.h>

namespace tessera {

std::string describe_element(const FileMesh& file, std::int64_t number, std::int64_t place,
                             std::span<const Index> vertices) {
  std::vector<std::int64_t> numbers;
  for (const Index v : vertices) numbers.push_back(file.point_numbers[static_cast<std::size_t>(v)]);
  return locate(file.path, file.unit, place) + fmt::format("element {} (nodes {})", number, fmt::join(numbers, ", "));
}

std::string describe_point(const FileMesh& file, std::size_t point) {
  const Vec3& X = file.points[point];
  return fmt::format("node {} at ({:.9g}, {:.9g}, {:.9g})", file.point_numbers[point], X.x, X.y, X.z);
}

}  // namespace tessera
