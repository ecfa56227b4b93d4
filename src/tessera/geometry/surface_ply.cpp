#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "tessera/base/error.hpp"
#include "tessera/geometry/binary_cursor.hpp"
#include "tessera/geometry/surface_reader.hpp"
#include "tessera/geometry/text_cursor.hpp"

namespace tessera {
namespace {

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(Number type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  Number type{};
  std::optional<Number> length;  // of a list: how its length is written
  std::int64_t line = 0;         // in the file
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  std::optional<std::size_t> find(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == property) return i;
    return {};
  }
  /// The fewest bytes that one takes.
  std::size_t least_bytes(bool is_text) const {
    std::size_t bytes = 0;
    for (const Property& p : properties) bytes += is_text ? 2 : size_of(p.length.value_or(p.type));
    return std::max<std::size_t>(bytes, 1);
  }
};

struct Header {
  std::optional<std::endian> order;  // nothing for text
  std::vector<Element> elements;
};

Number read_type(TextCursor& cursor) {
  constexpr std::array<std::pair<std::string_view, Number>, 16> known{{{"char", Number::int8},
                                                                       {"int8", Number::int8},
                                                                       {"uchar", Number::uint8},
                                                                       {"uint8", Number::uint8},
                                                                       {"short", Number::int16},
                                                                       {"int16", Number::int16},
                                                                       {"ushort", Number::uint16},
                                                                       {"uint16", Number::uint16},
                                                                       {"int", Number::int32},
                                                                       {"int32", Number::int32},
                                                                       {"uint", Number::uint32},
                                                                       {"uint32", Number::uint32},
                                                                       {"float", Number::float32},
                                                                       {"float32", Number::float32},
                                                                       {"double", Number::float64},
                                                                       {"float64", Number::float64}}};
  const std::string_view word = cursor.word();
  for (const auto& [name, type] : known)
    if (word == name) return type;
  cursor.fail(fmt::format("the type of a property is expected here (char to double), found {}", excerpt(word)));
}

std::optional<std::endian> read_format(TextCursor& cursor) {
  cursor.expect("ply");
  cursor.expect("format");
  const std::string_view format = cursor.word();
  if (format == "ascii") return {};
  if (format == "binary_little_endian") return std::endian::little;
  if (format == "binary_big_endian") return std::endian::big;
  cursor.fail(
      fmt::format("the format {} is none of ascii, binary_little_endian and binary_big_endian", excerpt(format)));
}

Property read_property(TextCursor& cursor) {
  Property property;
  if (cursor.peek() == "list") {
    cursor.word();
    property.length = read_type(cursor);
  }
  property.type = read_type(cursor);
  property.name = cursor.word();
  property.line = cursor.line();
  return property;
}

Header read_header(TextCursor& cursor) {
  Header header;
  header.order = read_format(cursor);
  cursor.skip_line();  // the version, which was always 1.0
  for (std::string_view word = cursor.word(); word != "end_header"; word = cursor.word()) {
    if (word == "element") {
      const std::string name(cursor.word());
      header.elements.push_back({name, cursor.count(name, 1), {}});
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(cursor));
    } else if (word != "comment" && word != "obj_info") {
      cursor.fail(fmt::format("\"element\", \"property\", \"comment\" or \"end_header\" is expected here, found {}",
                              excerpt(word)));
    }
    cursor.skip_line();
  }
  return header;
}

/// The numbers of the body, as text.
struct TextNumbers {
  TextCursor& cursor;

  double read(Number) { return cursor.number(); }
  std::int64_t place() { return cursor.next_line(); }
  std::size_t bytes_left() const { return cursor.bytes_left(); }
  [[noreturn]] void fail(const std::string& message) const { cursor.fail(message); }
};

/// The numbers of the body, in binary.
struct BinaryNumbers {
  BinaryCursor cursor;

  double read(Number type) {
    switch (type) {
      case Number::int8:
        return cursor.read<std::int8_t>();
      case Number::uint8:
        return cursor.read<std::uint8_t>();
      case Number::int16:
        return cursor.read<std::int16_t>();
      case Number::uint16:
        return cursor.read<std::uint16_t>();
      case Number::int32:
        return cursor.read<std::int32_t>();
      case Number::uint32:
        return cursor.read<std::uint32_t>();
      case Number::float32:
        return static_cast<double>(cursor.read<float>());
      case Number::float64:
        return cursor.read<double>();
    }
    return 0.0;
  }
  std::int64_t place() const { return cursor.place(); }
  std::size_t bytes_left() const { return cursor.bytes_left(); }
  [[noreturn]] void fail(const std::string& message) const { cursor.fail(message); }
};

template <class Numbers>
class BodyReader {
 public:
  BodyReader(Numbers numbers, bool is_text, FileSurfaceBuilder& builder)
      : numbers_(numbers), is_text_(is_text), builder_(builder), side_(builder.side(kNamelessSide)) {}

  void read(const Element& element) {
    if (element.count > numbers_.bytes_left() / element.least_bytes(is_text_))
      numbers_.fail(
          fmt::format("{} elements \"{}\" are announced, but the rest of the file has {} bytes: it is truncated "
                      "or damaged; write it again",
                      element.count, element.name, numbers_.bytes_left()));
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") {
      if (builder_.vertices() == 0 && element.count > 0)
        numbers_.fail("no vertices are given above the faces: write the element \"vertex\" first");
      return read_faces(element);
    }
    if (element.name == "tristrips") numbers_.fail("triangle strips cannot be used: write triangles");
    for (std::size_t i = 0; i < element.count; ++i) read_one(element);
  }

 private:
  /// The values of one element; of lists only the length is kept, and the last list's items.
  void read_one(const Element& element) {
    values_.clear();
    for (const Property& property : element.properties) {
      values_.push_back(numbers_.read(property.length.value_or(property.type)));
      if (property.length) read_items(property, values_.back());
    }
  }

  void read_items(const Property& property, double length) {
    const double most = static_cast<double>(numbers_.bytes_left() / (is_text_ ? 2 : size_of(property.type)) + 1);
    if (!(length >= 0 && length <= most && length == std::floor(length)))
      numbers_.fail(
          fmt::format("a list cannot have {} items here: the file is truncated or damaged; write it again", length));
    std::vector<double>& items = is_corners(property) ? corners_ : others_;
    items.clear();
    for (auto i = static_cast<std::size_t>(length); i > 0; --i) items.push_back(numbers_.read(property.type));
  }

  static bool is_corners(const Property& property) {
    return property.name == "vertex_indices" || property.name == "vertex_index";
  }

  void read_vertices(const Element& element) {
    std::array<std::size_t, 3> place{};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto found = element.find(std::string(1, "xyz"[d]));
      if (!found) numbers_.fail("the vertices have no coordinates: the properties x, y and z are needed");
      place[d] = *found;
      refuse_list(element.properties[*found]);
    }
    for (std::size_t i = 0; i < element.count; ++i) {
      read_one(element);
      builder_.add_vertex({values_[place[0]], values_[place[1]], values_[place[2]]});
    }
  }

  void refuse_list(const Property& coordinate) const {
    if (!coordinate.length) return;
    throw GeometryError(locate(builder_.file().path, PlaceUnit::line, coordinate.line) +
                        fmt::format("the coordinate {0} of vertices is a list; one number is allowed, as in \"property "
                                    "float {0}\" or \"property double {0}\"",
                                    coordinate.name));
  }

  void read_faces(const Element& element) {
    const auto has_corners = [](const Property& p) { return p.length && is_corners(p); };
    if (std::none_of(element.properties.begin(), element.properties.end(), has_corners))
      numbers_.fail("the faces have no corners: a list vertex_indices is needed");
    std::vector<Index> corners;
    for (std::size_t i = 0; i < element.count; ++i) {
      const std::int64_t place = numbers_.place();
      read_one(element);
      corners.clear();
      for (const double number : corners_) corners.push_back(index_of(number, place));
      builder_.add_polygon(corners, side_, place);
    }
  }

  Index index_of(double number, std::int64_t place) const {
    if (number >= 0 && number < builder_.vertices() && number == std::floor(number)) return static_cast<Index>(number);
    throw GeometryError(fmt::format("{}there is no vertex {}: numbers from 0 to {} are allowed",
                                    locate(builder_.file().path, builder_.file().unit, place), number,
                                    builder_.vertices() - 1));
  }

  Numbers numbers_;
  bool is_text_;
  FileSurfaceBuilder& builder_;
  Index side_;
  std::vector<double> values_, corners_, others_;
};

template <class Numbers>
FileSurface read_body(const std::string& path, const Header& header, Numbers numbers) {
  FileSurfaceBuilder builder(path, header.order ? PlaceUnit::byte : PlaceUnit::line);
  BodyReader<Numbers> body(numbers, !header.order, builder);
  for (const Element& element : header.elements) body.read(element);
  return std::move(builder.file());
}

}  // namespace

FileSurface read_ply(const std::string& path, std::string_view bytes) {
  TextCursor cursor(path, bytes, 0);
  const Header header = read_header(cursor);
  if (!header.order) return read_body(path, header, TextNumbers{cursor});
  const std::string_view rest = bytes.substr(cursor.position());
  const std::size_t body =
      bytes.size() - rest.size() + std::min<std::size_t>(rest.starts_with("\r\n") ? 2 : 1, rest.size());
  return read_body(path, header, BinaryNumbers{BinaryCursor(path, bytes, body, *header.order)});
}

}  // namespace tessera
