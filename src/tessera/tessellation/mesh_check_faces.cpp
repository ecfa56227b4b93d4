#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tessera/base/error.hpp"
#include "tessera/tessellation/mesh_check.hpp"

namespace tessera {
namespace {

using Edge = std::array<Index, 2>;

constexpr const char* overlap_cure = "make the mesh conforming (in Gmsh: fragment the volumes, Coherence)";

const FileElement<Tetrahedron>& element_of(const FileMesh& file, const TetrahedronFace& face) {
  return file.tetrahedra[static_cast<std::size_t>(face.tetrahedron)];
}

void refuse_bad_uses(const FileMesh& file, std::span<const TetrahedronFace> uses) {
  const std::string_view what = uses.size() > 2 ? "use one face"
                                : uses.size() == 2 && uses[0].vertices == uses[1].vertices
                                    ? "lie on the same side of one face (they overlap)"
                                    : "";
  if (what.empty()) return;
  std::vector<std::int64_t> others;
  for (const TetrahedronFace& use : uses.subspan(1)) others.push_back(element_of(file, use).number);
  throw GeometryError(fmt::format("{} and element{} {} {}: {}", describe_element(file, element_of(file, uses[0])),
                                  others.size() > 1 ? "s" : "", fmt::join(others, ", "), what, overlap_cure));
}

std::vector<Edge> edges_of(std::span<const Triangle> boundary) {
  std::vector<Edge> edges;
  edges.reserve(3 * boundary.size());
  for (const Triangle& t : boundary)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// On a closed surface an edge lies between an even number of triangles; more than two where parts touch in it only.
void refuse_hinges(const FileMesh& file, std::span<const Triangle> boundary) {
  const std::vector<Edge> edges = edges_of(boundary);
  for (std::size_t i = 0; i + 2 < edges.size(); i += 2) {
    if (edges[i] != edges[i + 2]) continue;
    throw GeometryError(
        fmt::format("{}: parts of the mesh touch only in the edge between {} and {}: join them by faces, or "
                    "separate them",
                    file.path, describe_point(file, static_cast<std::size_t>(edges[i][0])),
                    describe_point(file, static_cast<std::size_t>(edges[i][1]))));
  }
}

}  // namespace

std::vector<Triangle> closed_boundary(const FileMesh& file) {
  std::vector<Tetrahedron> tetrahedra;
  tetrahedra.reserve(file.tetrahedra.size());
  for (const auto& element : file.tetrahedra) tetrahedra.push_back(element.vertices);
  const std::vector<TetrahedronFace> faces = sorted_faces(tetrahedra);
  std::vector<Triangle> boundary;
  for_each_face(faces, [&](std::span<const TetrahedronFace> uses) {
    refuse_bad_uses(file, uses);
    if (uses.size() == 1) boundary.push_back(uses[0].vertices);
  });
  std::sort(boundary.begin(), boundary.end());
  refuse_hinges(file, boundary);
  return boundary;
}

}  // namespace tessera
