#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/geometry/file_place.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// Numbers of four vertices.
using Tetrahedron = std::array<Index, 4>;

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

/// What a mesh file says, before anything about it is believed but that its indices are in range.
struct FileMesh {
  std::string path;
  PlaceUnit unit = PlaceUnit::line;
  std::vector<Vec3> points;
  std::vector<std::int64_t> point_numbers;  // the file's own
  std::vector<FileElement<Tetrahedron>> tetrahedra;
  std::vector<FileTriangle> triangles;                    // those that name a surface
  std::vector<FileElement<Triangle>> nameless_triangles;  // all others
  std::vector<NamedSurface> surfaces;                     // a surface without an entry is called by its number
};

/// "path:12: element 7 (nodes 3, 5, 8, 9)", with the file's own numbers.
std::string describe_element(const FileMesh& file, std::int64_t number, std::int64_t place,
                             std::span<const Index> vertices);

template <class Vertices>
std::string describe_element(const FileMesh& file, const FileElement<Vertices>& element) {
  return describe_element(file, element.number, element.place, element.vertices);
}

/// "node 7 at (0, 0.5, 1)".
std::string describe_point(const FileMesh& file, std::size_t point);

}  // namespace tessera
