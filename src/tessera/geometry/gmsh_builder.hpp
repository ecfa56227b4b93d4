#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "tessera/geometry/gmsh_cursor.hpp"
#include "tessera/geometry/mesh_file.hpp"

namespace tessera {

/// What becomes of an element: points and lines are passed over.
enum class GmshElementUse { none, triangle, tetrahedron };

struct GmshElementKind {
  GmshElementUse use = GmshElementUse::none;
  std::size_t nodes = 0;
};

/// Collects the nodes and elements of a Gmsh file, whatever the format's version.
class GmshBuilder {
 public:
  GmshBuilder(FileMesh& mesh, GmshCursor& cursor) : mesh_(mesh), cursor_(cursor) {}

  /// Looks up a type number of the format. Throws GeometryError for anything but points, lines, and linear triangles
  /// and tetrahedra.
  GmshElementKind kind_of(int type);
  /// Throws GeometryError when the file has this node already.
  void add_node(std::int64_t number, const Vec3& X);
  /// Adds an element with these nodes; a triangle once for each of its physical surfaces.
  void add_element(const GmshElementKind& kind, std::int64_t number, std::int64_t place,
                   std::span<const std::int64_t> nodes, std::span<const int> physical);

 private:
  Index index_of(std::int64_t node, std::int64_t element);

  FileMesh& mesh_;
  GmshCursor& cursor_;
  std::unordered_map<std::int64_t, Index> index_of_;  // only looked up, never walked
};

/// The sections of format 2.2; the cursor stands behind the section's name line.
void read_nodes_22(GmshCursor& cursor, GmshBuilder& builder);
void read_elements_22(GmshCursor& cursor, GmshBuilder& builder);

/// The physical groups of the surfaces of format 4.1, by the surface's tag.
using GmshSurfaces = std::unordered_map<int, std::vector<int>>;

/// The sections of format 4.1.
GmshSurfaces read_entities_41(GmshCursor& cursor);
void read_nodes_41(GmshCursor& cursor, GmshBuilder& builder);
void read_elements_41(GmshCursor& cursor, GmshBuilder& builder, const GmshSurfaces& surfaces);

}  // namespace tessera
