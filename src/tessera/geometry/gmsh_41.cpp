#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "tessera/geometry/gmsh_builder.hpp"

namespace tessera {
namespace {

/// A dimension (0 to 3) of an entity.
int read_dimension(GmshCursor& cursor) {
  const int dimension = cursor.read_int();
  if (dimension < 0 || dimension > 3)
    cursor.fail(
        fmt::format("an entity of dimension {} is none of 0 to 3: the file is damaged; write it again", dimension));
  return dimension;
}

/// Tag, box (a point for dimension 0), physical groups, and (above dimension 0) bounding entities, which nothing needs.
std::pair<int, std::vector<int>> read_entity(GmshCursor& cursor, int dimension) {
  const int tag = cursor.read_int();
  cursor.skip_doubles(dimension == 0 ? 3 : 6);
  std::vector<int> physical(cursor.check_count(cursor.read_long(), 2, "physical groups"));
  for (int& group : physical) group = std::abs(cursor.read_int());
  if (dimension > 0) {
    const std::size_t bounding = cursor.check_count(cursor.read_long(), 2, "bounding entities");
    for (std::size_t i = 0; i < bounding; ++i) cursor.read_int();
  }
  return {tag, physical};
}

void read_node_block(GmshCursor& cursor, GmshBuilder& builder) {
  const int dimension = read_dimension(cursor);
  cursor.read_int();  // the entity's tag
  const std::size_t parameters = cursor.read_int() != 0 ? static_cast<std::size_t>(dimension) : 0;
  std::vector<std::int64_t> numbers(cursor.check_count(cursor.read_long(), 8, "nodes"));
  for (std::int64_t& number : numbers) number = cursor.read_long();
  for (const std::int64_t number : numbers) {
    const double x = cursor.read_double(), y = cursor.read_double(), z = cursor.read_double();
    cursor.skip_doubles(parameters);
    cursor.expect_line_end();
    builder.add_node(number, {x, y, z});
  }
}

std::span<const int> groups_of(const GmshSurfaces& surfaces, int dimension, int tag) {
  const auto found = surfaces.find(tag);
  return dimension == 2 && found != surfaces.end() ? std::span<const int>(found->second) : std::span<const int>();
}

void read_element_block(GmshCursor& cursor, GmshBuilder& builder, const GmshSurfaces& surfaces) {
  const int dimension = read_dimension(cursor);
  const std::span<const int> groups = groups_of(surfaces, dimension, cursor.read_int());
  const GmshElementKind kind = builder.kind_of(cursor.read_int());
  const std::size_t count = cursor.check_count(cursor.read_long(), 4, "elements");
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t place = cursor.place();
    const std::int64_t number = cursor.read_long();
    std::array<std::int64_t, 4> nodes{};
    for (std::size_t n = 0; n < kind.nodes; ++n) nodes[n] = cursor.read_long();
    cursor.expect_line_end();
    builder.add_element(kind, number, place, nodes, groups);
  }
}

/// Number of blocks, and how many things they hold, which the blocks repeat; smallest and largest number are of no use
/// here.
std::size_t read_section_header(GmshCursor& cursor) {
  const std::size_t blocks = cursor.check_count(cursor.read_long(), 8, "blocks");
  for (int i = 0; i < 3; ++i) cursor.read_long();
  return blocks;
}

}  // namespace

GmshSurfaces read_entities_41(GmshCursor& cursor) {
  std::array<std::size_t, 4> count{};
  for (std::size_t& c : count) c = cursor.check_count(cursor.read_long(), 8, "entities");
  GmshSurfaces surfaces;
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < count[static_cast<std::size_t>(dimension)]; ++i) {
      auto [tag, physical] = read_entity(cursor, dimension);
      if (dimension == 2) surfaces[tag] = std::move(physical);
    }
  return surfaces;
}

void read_nodes_41(GmshCursor& cursor, GmshBuilder& builder) {
  const std::size_t blocks = read_section_header(cursor);
  for (std::size_t i = 0; i < blocks; ++i) read_node_block(cursor, builder);
}

void read_elements_41(GmshCursor& cursor, GmshBuilder& builder, const GmshSurfaces& surfaces) {
  const std::size_t blocks = read_section_header(cursor);
  for (std::size_t i = 0; i < blocks; ++i) read_element_block(cursor, builder, surfaces);
}

}  // namespace tessera
