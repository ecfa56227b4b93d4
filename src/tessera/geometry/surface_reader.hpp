#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tessera/geometry/file_surface.hpp"

namespace tessera {

/// Reads a triangulated surface: STL (text, binary), Wavefront OBJ, PLY (text, binary), OFF, Gmsh .msh (2.2, 4.1), by
/// the ending of the file's name. What the file groups (solids, objects, groups, materials, physical surfaces) become
/// sides; what it does not group is the side "surface". Polygons are divided into triangles. Throws GeometryError with
/// file and line or byte for files that are missing, truncated, damaged, or hold something else.
FileSurface read_surface(const std::string& path);

/// The bytes of one file each; `path` is for errors only.
FileSurface read_stl(const std::string& path, std::string_view bytes);
FileSurface read_obj(const std::string& path, std::string_view bytes);
FileSurface read_ply(const std::string& path, std::string_view bytes);
FileSurface read_off(const std::string& path, std::string_view bytes);
FileSurface read_msh_surface(const std::string& path, std::string_view bytes);

/// The side of triangles that no group of the file names.
inline constexpr std::string_view kNamelessSide = "surface";

/// Collects what a file says about its surface.
class FileSurfaceBuilder {
 public:
  FileSurfaceBuilder(const std::string& path, PlaceUnit unit);

  void add_vertex(const Vec3& X) { file_.surface.vertices.push_back(X); }
  Index vertices() const { return static_cast<Index>(file_.surface.vertices.size()); }
  /// The number of the side of this name, a new one if need be.
  Index side(std::string_view name);
  void add_triangle(const Triangle& triangle, Index side, std::int64_t place);
  /// A simple polygon, flat or nearly so, divided into triangles. Throws GeometryError at `place` when it has fewer
  /// than three corners or crosses itself.
  void add_polygon(std::span<const Index> corners, Index side, std::int64_t place);
  FileSurface& file() { return file_; }

 private:
  FileSurface file_;
  std::unordered_map<std::string, Index> side_of_name_;  // only looked up, never walked
};

/// Divides a simple polygon into triangles by cutting off ears; gives places in `corners`. Collinear corners give
/// triangles without area. Empty when the polygon crosses itself.
std::vector<std::array<std::size_t, 3>> cut_ears(std::span<const Vec3> corners);

}  // namespace tessera
