#include <algorithm>
#include <map>

#include "tessera/base/error.hpp"
#include "tessera/tessellation/mesh_check.hpp"

namespace tessera {
namespace {

/// A named face: its vertices in ascending order and a surface.
struct Label {
  Triangle face{};
  int surface = 0;
  friend auto operator<=>(const Label&, const Label&) = default;
};

std::vector<Label> labels_of(const FileMesh& file) {
  std::vector<Label> labels;
  for (const FileTriangle& t : file.triangles) labels.push_back({ascending(t.vertices), t.surface});
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

std::vector<Triangle> all_faces(const TetrahedralMesh& mesh) {
  const std::vector<TetrahedronFace> faces = sorted_faces(mesh.tetrahedra);
  std::vector<Triangle> keys;
  for_each_face(faces, [&](std::span<const TetrahedronFace> uses) { keys.push_back(ascending(uses[0].vertices)); });
  std::sort(keys.begin(), keys.end());
  return keys;
}

void refuse_foreign_triangles(const FileMesh& file, const TetrahedralMesh& mesh) {
  if (file.triangles.empty()) return;
  const std::vector<Triangle> faces = all_faces(mesh);
  for (const FileTriangle& t : file.triangles)
    if (!std::binary_search(faces.begin(), faces.end(), ascending(t.vertices)))
      throw GeometryError(describe_element(file, t) +
                          " is a triangle of a named surface but no face of a tetrahedron: write surfaces and volumes "
                          "of one and the same mesh");
}

std::string name_of(const FileMesh& file, int surface) {
  for (const NamedSurface& named : file.surfaces)
    if (named.surface == surface) return named.name;
  return std::to_string(surface);
}

/// The surfaces that a face belongs to, ascending.
std::vector<int> surfaces_at(const std::vector<Label>& labels, const Triangle& face) {
  std::vector<int> surfaces;
  for (auto label = std::lower_bound(labels.begin(), labels.end(), Label{face, 0});
       label != labels.end() && label->face == face; ++label)
    surfaces.push_back(label->surface);
  return surfaces;
}

}  // namespace

void name_sides(const FileMesh& file, TetrahedralMesh& mesh) {
  refuse_foreign_triangles(file, mesh);
  const std::vector<Label> labels = labels_of(file);
  std::map<std::vector<int>, std::vector<std::size_t>> faces_of;  // boundary triangles by their set of surfaces
  for (std::size_t i = 0; i < mesh.boundary.size(); ++i)
    faces_of[surfaces_at(labels, ascending(mesh.boundary[i].vertices))].push_back(i);
  faces_of.erase(std::vector<int>{});  // the unnamed rest
  for (const auto& [surfaces, faces] : faces_of) {
    for (const std::size_t i : faces) mesh.boundary[i].side = static_cast<Index>(mesh.side_names.size());
    mesh.side_names.emplace_back();
    for (const int surface : surfaces) mesh.side_names.back().push_back(name_of(file, surface));
  }
}

}  // namespace tessera
