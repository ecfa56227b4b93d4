#include "tessera/tessellation/mesh_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tessera/base/error.hpp"

namespace tessera {

std::string locate(const std::string& path, PlaceUnit unit, std::int64_t place) {
  return unit == PlaceUnit::line ? fmt::format("{}:{}: ", path, place) : fmt::format("{}: byte {}: ", path, place);
}

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

std::string read_whole_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw GeometryError(path +
                        ": cannot be read: no such file; paths count from the folder where the program is called");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad() || !stream.is_open()) throw GeometryError(path + ": cannot be read: check its permissions");
  if (bytes.empty()) throw GeometryError(path + ": the file is empty: write the mesh again");
  return bytes;
}

}  // namespace tessera
