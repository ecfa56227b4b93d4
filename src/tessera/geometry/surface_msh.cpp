#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/geometry/gmsh.hpp"
#include "tessera/geometry/surface_reader.hpp"

namespace tessera {
namespace {

std::string name_of(const FileMesh& mesh, int group) {
  for (const NamedSurface& surface : mesh.surfaces)
    if (surface.surface == group) return surface.name;
  return std::to_string(group);
}

}  // namespace

FileSurface read_msh_surface(const std::string& path, std::string_view bytes) {
  FileMesh mesh = read_gmsh(path, bytes);
  if (mesh.triangles.empty() && mesh.nameless_triangles.empty())
    throw GeometryError(path +
                        ": holds no triangles: mesh the surfaces (gmsh -2), and where anything has a physical "
                        "group give one to them");
  FileSurfaceBuilder builder(path, mesh.unit);
  builder.file().surface.vertices = std::move(mesh.points);
  std::int64_t last = -1;
  for (const FileTriangle& triangle : mesh.triangles) {
    if (triangle.place == last) continue;  // in a second group
    last = triangle.place;
    builder.add_triangle(triangle.vertices, builder.side(name_of(mesh, triangle.surface)), triangle.place);
  }
  for (const auto& triangle : mesh.nameless_triangles)
    builder.add_triangle(triangle.vertices, builder.side(kNamelessSide), triangle.place);
  return std::move(builder.file());
}

}  // namespace tessera
