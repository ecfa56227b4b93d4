#include "tessera/geometry/surface_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "tessera/base/error.hpp"
#include "tessera/geometry/predicates.hpp"
#include "tessera/geometry/text_cursor.hpp"

namespace tessera {

FileSurfaceBuilder::FileSurfaceBuilder(const std::string& path, PlaceUnit unit) : file_{path, unit, {}, {}} {}

Index FileSurfaceBuilder::side(std::string_view name) {
  std::vector<std::string>& names = file_.surface.side_names;
  const auto [entry, is_new] = side_of_name_.try_emplace(std::string(name), static_cast<Index>(names.size()));
  if (is_new) names.emplace_back(name);
  return entry->second;
}

void FileSurfaceBuilder::add_triangle(const Triangle& triangle, Index side, std::int64_t place) {
  file_.surface.triangles.push_back(triangle);
  file_.surface.side.push_back(side);
  file_.place.push_back(place);
}

void FileSurfaceBuilder::add_polygon(std::span<const Index> corners, Index side, std::int64_t place) {
  const std::string where = locate(file_.path, file_.unit, place);
  if (corners.size() < 3)
    throw GeometryError(fmt::format("{}a face has {} corners; at least 3 are needed", where, corners.size()));
  if (corners.size() == 3) return add_triangle({corners[0], corners[1], corners[2]}, side, place);
  std::vector<Vec3> X;
  for (const Index v : corners) X.push_back(file_.surface.vertex(v));
  if (!std::all_of(X.begin(), X.end(), is_usable))
    throw GeometryError(
        fmt::format("{}a face has a corner whose coordinates are no numbers below {:g}", where, kLargestCoordinate));
  const auto triangles = cut_ears(X);
  if (triangles.empty())
    throw GeometryError(
        fmt::format("{}the outline of a face with {} corners crosses itself or is not flat: let the "
                    "program that wrote the file divide its faces into triangles",
                    where, corners.size()));
  for (const auto& [i, j, k] : triangles) add_triangle({corners[i], corners[j], corners[k]}, side, place);
}

FileSurface read_surface(const std::string& path) {
  struct Format {
    std::string_view ending;
    FileSurface (*read)(const std::string& path, std::string_view bytes);
  };
  constexpr std::array<Format, 5> formats{
      {{".stl", read_stl}, {".obj", read_obj}, {".ply", read_ply}, {".off", read_off}, {".msh", read_msh_surface}}};
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const Format& format : formats)
    if (same_word(ending, format.ending)) return format.read(path, read_whole_file(path));
  throw GeometryError(path + ": is no surface file by its name: .stl, .obj, .ply, .off and .msh files can be read");
}

}  // namespace tessera
