#include <fmt/format.h>

#include <array>

#include "tessera/geometry/surface_reader.hpp"
#include "tessera/geometry/text_cursor.hpp"

namespace tessera {
namespace {

/// The first word says what vertices carry beside their place, which nothing needs; it may be left out.
void read_keyword(TextCursor& cursor) {
  constexpr std::array<std::string_view, 8> known{"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                  "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  const std::string_view first = cursor.peek();
  if (!first.ends_with("OFF")) return;
  cursor.word();
  if (std::find(known.begin(), known.end(), first) == known.end())
    cursor.fail(fmt::format("the kind {} of OFF file cannot be read: vertices need three coordinates (OFF, COFF, NOFF)",
                            excerpt(first)));
  if (!cursor.at_line_end() && same_word(cursor.peek(), "BINARY"))
    cursor.fail("a binary OFF file cannot be read: write it as text, or as binary PLY or STL");
}

Index read_index(TextCursor& cursor, Index vertices) {
  const std::int64_t i = cursor.integer();
  if (i < 0 || i >= vertices)
    cursor.fail(fmt::format("there is no vertex {}: numbers from 0 to {} are allowed", i, vertices - 1));
  return static_cast<Index>(i);
}

}  // namespace

FileSurface read_off(const std::string& path, std::string_view bytes) {
  TextCursor cursor(path, without_byte_order_mark(bytes), '#');
  read_keyword(cursor);
  const std::size_t vertices = cursor.count("vertices", 5), faces = cursor.count("faces", 2);
  cursor.skip_line();  // the number of edges, which many programs leave zero
  FileSurfaceBuilder builder(path, PlaceUnit::line);
  for (std::size_t i = 0; i < vertices; ++i) {
    const double x = cursor.number(), y = cursor.number(), z = cursor.number();
    builder.add_vertex({x, y, z});
    cursor.skip_line();
  }
  const Index side = builder.side(kNamelessSide);
  std::vector<Index> corners;
  for (std::size_t i = 0; i < faces; ++i) {
    corners.resize(cursor.count("corners", 2));
    const std::int64_t line = cursor.line();
    for (Index& v : corners) v = read_index(cursor, builder.vertices());
    cursor.skip_line();  // a colour
    builder.add_polygon(corners, side, line);
  }
  return std::move(builder.file());
}

}  // namespace tessera
