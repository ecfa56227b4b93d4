#include <algorithm>
#include <cctype>
#include <filesystem>

#include "tessera/base/error.hpp"
#include "tessera/geometry/gmsh.hpp"
#include "tessera/tessellation/mesh_check.hpp"
#include "tessera/tessellation/vtu.hpp"

namespace tessera {
namespace {

std::string lower_case_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

FileMesh read_any(const std::string& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".msh") return read_gmsh(path, read_whole_file(path));
  if (extension == ".vtu") return read_vtu(path, read_whole_file(path));
  throw GeometryError(path + ": is no mesh file by its name: give a Gmsh .msh or a VTK .vtu file");
}

}  // namespace

TetrahedralMesh checked_mesh(const FileMesh& file) {
  if (file.tetrahedra.empty())
    throw GeometryError(
        file.path +
        ": holds no tetrahedra: mesh the volume, and in Gmsh give it a physical group when anything has one");
  refuse_bad_points(file);
  refuse_bad_tetrahedra(file);
  TetrahedralMesh mesh;
  mesh.points = file.points;
  for (const auto& element : file.tetrahedra) mesh.tetrahedra.push_back(element.vertices);
  put_in_order(mesh.tetrahedra);
  for (const Triangle& face : closed_boundary(file)) mesh.boundary.push_back({face, -1});
  name_sides(file, mesh);
  return mesh;
}

TetrahedralMesh read_mesh(const std::string& path) { return checked_mesh(read_any(path)); }

}  // namespace tessera
