#include "tessera/geometry/gmsh_builder.hpp"

#include <fmt/format.h>

namespace tessera {

GmshElementKind GmshBuilder::kind_of(int type) {
  switch (type) {
    case 15:
      return {GmshElementUse::none, 1};
    case 1:
      return {GmshElementUse::none, 2};
    case 2:
      return {GmshElementUse::triangle, 3};
    case 4:
      return {GmshElementUse::tetrahedron, 4};
    case 3:
    case 5:
    case 6:
    case 7:
      cursor_.fail(fmt::format(
          "element type {} ({}) cannot be used: mesh with linear tetrahedra and triangles only (no Recombine)", type,
          type == 3 ? "quadrangle" : (type == 5 ? "hexahedron" : (type == 6 ? "prism" : "pyramid"))));
    default:
      cursor_.fail(
          fmt::format("element type {} (curved, of higher order or special) cannot be used: write linear elements "
                      "(Mesh.ElementOrder = 1)",
                      type));
  }
}

void GmshBuilder::add_node(std::int64_t number, const Vec3& X) {
  if (!index_of_.emplace(number, static_cast<Index>(mesh_.points.size())).second)
    cursor_.fail(fmt::format("node {} is in the file twice: give every node its own number", number));
  mesh_.points.push_back(X);
  mesh_.point_numbers.push_back(number);
}

void GmshBuilder::add_element(const GmshElementKind& kind, std::int64_t number, std::int64_t place,
                              std::span<const std::int64_t> nodes, std::span<const int> physical) {
  if (kind.use == GmshElementUse::tetrahedron) {
    Tetrahedron t{};
    for (std::size_t i = 0; i < 4; ++i) t[i] = index_of(nodes[i], number);
    mesh_.tetrahedra.push_back({t, number, place});
  } else if (kind.use == GmshElementUse::triangle) {
    Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = index_of(nodes[i], number);
    if (physical.empty()) mesh_.nameless_triangles.push_back({t, number, place});
    for (const int surface : physical) mesh_.triangles.push_back({{t, number, place}, surface});
  }
}

Index GmshBuilder::index_of(std::int64_t node, std::int64_t element) {
  const auto found = index_of_.find(node);
  if (found == index_of_.end())
    cursor_.fail(fmt::format("element {} has node {}, which is not in $Nodes: write the mesh again with all its nodes",
                             element, node));
  return found->second;
}

}  // namespace tessera
