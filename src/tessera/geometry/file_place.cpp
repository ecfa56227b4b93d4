#include "tessera/geometry/file_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tessera/base/error.hpp"

namespace tessera {

std::string locate(const std::string& path, PlaceUnit unit, std::int64_t place) {
  return unit == PlaceUnit::line ? fmt::format("{}:{}: ", path, place) : fmt::format("{}: byte {}: ", path, place);
}

void require_file(const std::string& path, const Origin& origin) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw GeometryError(describe(origin) + path + ": no such file; paths in a case file count from its folder");
}

std::string read_whole_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw GeometryError(path + ": cannot be read: it is a folder");
  if (!std::filesystem::is_regular_file(path, error))
    throw GeometryError(path + ": cannot be read: no such file; paths in a case file count from its folder");
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream.is_open()) throw GeometryError(path + ": cannot be read: check its permissions");
  std::string bytes(static_cast<std::size_t>(std::max<std::streamoff>(stream.tellg(), 0)), '\0');
  stream.seekg(0);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw GeometryError(path + ": could not be read to its end");
  if (bytes.empty()) throw GeometryError(path + ": the file is empty: write it again");
  return bytes;
}

}  // namespace tessera
