#include <array>
#include <cstdlib>

#include "tessera/geometry/gmsh_builder.hpp"

namespace tessera {
namespace {

/// Type and number of tags: of one element in ASCII, of a block of them in binary.
struct ElementHeader {
  GmshElementKind kind;
  int tags = 0;
};

ElementHeader read_header(GmshCursor& cursor, GmshBuilder& builder, int type, int tags) {
  if (tags < 0) cursor.fail("an element has a negative number of tags: the file is damaged; write it again");
  return {builder.kind_of(type), tags};
}

/// Tags and nodes. The first tag is the physical group, 0 for none; its sign is the orientation.
void read_body(GmshCursor& cursor, GmshBuilder& builder, const ElementHeader& header, std::int64_t number,
               std::int64_t place) {
  std::array<int, 1> physical{};
  for (int i = 0; i < header.tags; ++i) {
    const int tag = cursor.read_int();
    if (i == 0) physical[0] = std::abs(tag);
  }
  std::array<std::int64_t, 4> nodes{};
  for (std::size_t i = 0; i < header.kind.nodes; ++i) nodes[i] = cursor.read_int();
  cursor.expect_line_end();
  builder.add_element(header.kind, number, place, nodes,
                      std::span<const int>(physical).first(physical[0] != 0 ? 1 : 0));
}

void read_element_ascii(GmshCursor& cursor, GmshBuilder& builder) {
  const std::int64_t place = cursor.place();
  const int number = cursor.read_int();
  const int type = cursor.read_int();
  const ElementHeader header = read_header(cursor, builder, type, cursor.read_int());
  read_body(cursor, builder, header, number, place);
}

std::size_t read_block_binary(GmshCursor& cursor, GmshBuilder& builder, std::size_t left) {
  const int type = cursor.read_int();
  const std::size_t count = cursor.check_count(cursor.read_int(), 4, "elements");
  const ElementHeader header = read_header(cursor, builder, type, cursor.read_int());
  if (count == 0 || count > left)
    cursor.fail("a block of elements has a wrong size: the file is damaged; write it again");
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t place = cursor.place();
    read_body(cursor, builder, header, cursor.read_int(), place);
  }
  return count;
}

}  // namespace

void read_nodes_22(GmshCursor& cursor, GmshBuilder& builder) {
  const std::size_t count = cursor.check_count(cursor.read_text_long(), 8, "nodes");
  cursor.skip_to_next_line();
  for (std::size_t i = 0; i < count; ++i) {
    const int number = cursor.read_int();
    const double x = cursor.read_double(), y = cursor.read_double(), z = cursor.read_double();
    cursor.expect_line_end();
    builder.add_node(number, {x, y, z});
  }
}

void read_elements_22(GmshCursor& cursor, GmshBuilder& builder) {
  const std::size_t count = cursor.check_count(cursor.read_text_long(), 8, "elements");
  cursor.skip_to_next_line();
  for (std::size_t done = 0; done < count;) {
    if (cursor.encoding() == GmshEncoding::ascii) {
      read_element_ascii(cursor, builder);
      ++done;
    } else {
      done += read_block_binary(cursor, builder, count - done);
    }
  }
}

}  // namespace tessera
