#include <fmt/format.h>

#include <limits>

#include "tessera/base/error.hpp"
#include "tessera/geometry/binary_cursor.hpp"
#include "tessera/geometry/surface_reader.hpp"
#include "tessera/geometry/text_cursor.hpp"

namespace tessera {
namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes of text, the number of triangles
constexpr std::size_t kFacet = 50;   // normal, three vertices, two bytes of attributes

void read_facet(TextCursor& cursor, FileSurfaceBuilder& builder, Index side) {
  const std::int64_t line = cursor.line();
  cursor.expect("normal");
  for (int i = 0; i < 3; ++i) cursor.word();  // the vertices' order says it better
  cursor.expect("outer");
  cursor.expect("loop");
  const Index first = builder.vertices();
  for (int i = 0; i < 3; ++i) {
    cursor.expect("vertex");
    const double x = cursor.number(), y = cursor.number(), z = cursor.number();
    builder.add_vertex({x, y, z});
  }
  cursor.expect("endloop");
  cursor.expect("endfacet");
  builder.add_triangle({first, first + 1, first + 2}, side, line);
}

FileSurface read_text(const std::string& path, std::string_view bytes) {
  TextCursor cursor(path, without_byte_order_mark(bytes), 0);
  FileSurfaceBuilder builder(path, PlaceUnit::line);
  while (!cursor.at_end()) {
    cursor.expect("solid");
    const std::string_view name = cursor.rest_of_line();
    const Index side = builder.side(name.empty() ? kNamelessSide : name);
    for (std::string_view word = cursor.word(); !same_word(word, "endsolid"); word = cursor.word()) {
      if (!same_word(word, "facet"))
        cursor.fail(
            fmt::format("\"facet\" or \"endsolid\" is expected here, found {}: the file is damaged; write it again",
                        excerpt(word)));
      read_facet(cursor, builder, side);
    }
    cursor.skip_line();
  }
  return std::move(builder.file());
}

std::size_t announced_facets(const std::string& path, std::string_view bytes) {
  if (bytes.size() < kHeader)
    throw GeometryError(
        fmt::format("{}: is no STL file: it does not begin with \"solid\", and its {} bytes are too few "
                    "for the header of a binary one",
                    path, bytes.size()));
  return BinaryCursor(path, bytes, kHeader - 4, std::endian::little).read<std::uint32_t>();
}

FileSurface read_binary(const std::string& path, std::string_view bytes) {
  const std::size_t facets = announced_facets(path, bytes);
  const std::size_t size = kHeader + kFacet * facets;
  if (bytes.size() != size)
    throw GeometryError(
        fmt::format("{}81: {} triangles are announced, which take {} bytes, but the file has {}: it is "
                    "{}; write it again",
                    path + ": byte ", facets, size, bytes.size(),
                    bytes.size() < size ? "truncated or damaged" : "damaged, or more was appended to it"));
  if (facets > static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 3)
    throw GeometryError(fmt::format("{}: {} triangles are too many", path, facets));
  FileSurfaceBuilder builder(path, PlaceUnit::byte);
  const Index side = builder.side(kNamelessSide);
  for (std::size_t i = 0; i < facets; ++i) {
    BinaryCursor cursor(path, bytes, kHeader + kFacet * i + 12, std::endian::little);
    const Index first = builder.vertices();
    for (int v = 0; v < 3; ++v) {
      const float x = cursor.read<float>(), y = cursor.read<float>(), z = cursor.read<float>();
      builder.add_vertex({x, y, z});
    }
    builder.add_triangle({first, first + 1, first + 2}, side, static_cast<std::int64_t>(kHeader + kFacet * i + 1));
  }
  return std::move(builder.file());
}

/// A binary file may begin with "solid" too, so its size decides, and else whether there is a zero byte near the front.
bool is_text(const std::string& path, std::string_view bytes) {
  if (bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * announced_facets(path, bytes)) return false;
  return same_word(without_byte_order_mark(bytes).substr(0, 5), "solid") &&
         bytes.substr(0, 512).find('\0') == std::string_view::npos;
}

}  // namespace

FileSurface read_stl(const std::string& path, std::string_view bytes) {
  return is_text(path, bytes) ? read_text(path, bytes) : read_binary(path, bytes);
}

}  // namespace tessera
