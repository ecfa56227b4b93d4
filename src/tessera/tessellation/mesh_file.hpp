#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/tessellation/mesh_faces.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {

/// An element as a file has it. `place` says where, as errors print it: a line or byte, counted from one.
template <class Vertices>
struct FileElement {
  Vertices vertices{};      // indices into FileMesh::points
  std::int64_t number = 0;  // the file's own
  std::int64_t place = 0;
};

/// A triangle and the number of the surface (physical group) that it belongs to.
struct FileTriangle : FileElement<Triangle> {
  int surface = 0;
};

struct NamedSurface {
  int surface = 0;
  std::string name;
};

enum class PlaceUnit { line, byte };

/// What a mesh file says, before anything about it is believed but that its indices are in range.
struct FileMesh {
  std::string path;
  PlaceUnit unit = PlaceUnit::line;
  std::vector<Vec3> points;
  std::vector<std::int64_t> point_numbers;  // the file's own
  std::vector<FileElement<Tetrahedron>> tetrahedra;
  std::vector<FileTriangle> triangles;  // only those that name a surface
  std::vector<NamedSurface> surfaces;   // a surface without an entry is called by its number
};

/// "path:12: " or "path: byte 345: ".
std::string locate(const std::string& path, PlaceUnit unit, std::int64_t place);

/// "path:12: element 7 (nodes 3, 5, 8, 9)", with the file's own numbers.
std::string describe_element(const FileMesh& file, std::int64_t number, std::int64_t place,
                             std::span<const Index> vertices);

template <class Vertices>
std::string describe_element(const FileMesh& file, const FileElement<Vertices>& element) {
  return describe_element(file, element.number, element.place, element.vertices);
}

/// "node 7 at (0, 0.5, 1)".
std::string describe_point(const FileMesh& file, std::size_t point);

/// The whole file. Throws GeometryError when it cannot be read or is empty.
std::string read_whole_file(const std::string& path);

/// The mesh that a file describes, checked: finite points, each used and none doubled; tetrahedra neither inverted nor
/// flat, each face between at most two of them and each edge of the boundary between two boundary triangles; every
/// named triangle is a face. Throws GeometryError with file, place, the file's own numbers and the cure.
TetrahedralMesh checked_mesh(const FileMesh& file);

}  // namespace tessera
