#include "tessera/tessellation/vtu_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <charconv>
#include <cstring>
#include <type_traits>

#include "tessera/tessellation/vtu_stream.hpp"

namespace tessera {
namespace {

constexpr std::uint64_t zlib_best_ratio = 1032;  // no deflate stream expands more

/// Reads one number of the array header, 4 or 8 bytes.
std::uint64_t read_header_number(VtuStream& stream, std::size_t width) {
  const std::string bytes = stream.read(width);
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data(), width);
  return value;
}

std::string inflate_block(VtuStream& stream, const std::string& compressed, std::uint64_t size) {
  if (size / zlib_best_ratio > compressed.size())
    stream.fail("a compressed block claims an impossible size: the file is damaged; write it again");
  std::string plain(static_cast<std::size_t>(size), '\0');
  uLongf length = static_cast<uLongf>(size);
  const int status =
      uncompress(reinterpret_cast<Bytef*>(plain.data()), &length, reinterpret_cast<const Bytef*>(compressed.data()),
                 static_cast<uLong>(compressed.size()));
  if (status != Z_OK || length != size)
    stream.fail("a compressed block cannot be unpacked: the file is damaged; write it again");
  return plain;
}

/// Layout: number of blocks, size of a block, size of the last one (0: a whole one), compressed sizes, blocks.
std::string read_compressed(VtuStream& stream, std::size_t width) {
  const std::uint64_t blocks = read_header_number(stream, width);
  const std::uint64_t size = read_header_number(stream, width);
  const std::uint64_t last_size = read_header_number(stream, width);
  if (blocks > stream.room() / width)
    stream.fail("the array claims more blocks than the file holds: it is damaged; write it again");
  std::vector<std::uint64_t> compressed_sizes(static_cast<std::size_t>(blocks));
  for (std::uint64_t& compressed : compressed_sizes) compressed = read_header_number(stream, width);
  std::string plain;
  for (std::size_t i = 0; i < compressed_sizes.size(); ++i) {
    const bool is_short = i + 1 == compressed_sizes.size() && last_size != 0;
    const std::string block = stream.read(compressed_sizes[i]);
    plain += inflate_block(stream, block, is_short ? last_size : size);
  }
  return plain;
}

VtuStream stream_of(const VtuLayout& layout, const VtuArray& array) {
  const std::string_view format = attribute(array.attributes, "format");
  if (format == "binary") return {layout, array.line, VtuEncoding::base64, array.text};
  if (format != "appended")
    layout.fail(array.line, fmt::format("format \"{}\" is none of ascii, binary, appended", format.substr(0, 20)));
  if (layout.appended_encoding.empty())
    layout.fail(array.line,
                "the array's data are appended, but no <AppendedData> follows: the file is truncated; write it again");
  const std::string_view text = attribute(array.attributes, "offset");
  std::uint64_t offset = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), offset);
  if (error != std::errc() || stop != text.data() + text.size() || offset > layout.appended.size())
    layout.fail(array.line,
                "the array's offset does not lie in the appended data: the file is truncated; write it again");
  if (layout.appended_encoding != "raw" && layout.appended_encoding != "base64")
    layout.fail(array.line,
                fmt::format("appended encoding \"{}\" is none of raw, base64", layout.appended_encoding.substr(0, 20)));
  const VtuEncoding encoding = layout.appended_encoding == "raw" ? VtuEncoding::raw : VtuEncoding::base64;
  return {layout, array.line, encoding, layout.appended.substr(static_cast<std::size_t>(offset))};
}

std::size_t header_width(const VtuLayout& layout) {
  const std::string_view type = attribute(layout.file, "header_type", "UInt32");
  if (type != "UInt32" && type != "UInt64")
    layout.fail(1, fmt::format("header_type \"{}\" is none of UInt32, UInt64", type.substr(0, 20)));
  return type == "UInt32" ? 4 : 8;
}

std::string binary_bytes(const VtuLayout& layout, const VtuArray& array) {
  const std::string_view compressor = attribute(layout.file, "compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    layout.fail(1, fmt::format("compressor \"{}\" cannot be read: write with zlib or none", compressor.substr(0, 40)));
  if (attribute(layout.file, "byte_order", "LittleEndian") != "LittleEndian")
    layout.fail(1, "the file has the opposite byte order (big-endian): write it on this kind of machine, or in ASCII");
  const std::size_t width = header_width(layout);
  VtuStream stream = stream_of(layout, array);
  return compressor.empty() ? stream.read(read_header_number(stream, width)) : read_compressed(stream, width);
}

template <class Out>
std::vector<Out> text_values(const VtuLayout& layout, const VtuArray& array) {
  std::vector<Out> values;
  const char* const end = array.text.data() + array.text.size();
  const char* begin = array.text.data();
  for (;;) {
    while (begin != end && (*begin == ' ' || *begin == '\n' || *begin == '\r' || *begin == '\t')) ++begin;
    if (begin == end) return values;
    Out value{};
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc())
      layout.fail(array.line, fmt::format("number {} of the array cannot be read: the file is damaged; write it again",
                                          values.size() + 1));
    values.push_back(value);
    begin = stop;
  }
}

template <class Stored, class Out>
std::vector<Out> stored_values(const VtuLayout& layout, const VtuArray& array) {
  const std::string bytes = binary_bytes(layout, array);
  if (bytes.size() % sizeof(Stored) != 0)
    layout.fail(array.line, "the array holds no whole number of values: the file is damaged; write it again");
  std::vector<Out> values(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Stored value;
    std::memcpy(&value, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    values[i] = static_cast<Out>(value);
  }
  return values;
}

[[noreturn]] void fail_type(const VtuLayout& layout, const VtuArray& array, std::string_view allowed) {
  layout.fail(array.line,
              fmt::format("type \"{}\" is none of {}", attribute(array.attributes, "type").substr(0, 20), allowed));
}

bool is_text(const VtuArray& array) { return attribute(array.attributes, "format", "ascii") == "ascii"; }

}  // namespace

std::vector<double> vtu_doubles(const VtuLayout& layout, const VtuArray& array) {
  const std::string_view type = attribute(array.attributes, "type");
  if (type != "Float64" && type != "Float32") fail_type(layout, array, "Float32, Float64");
  if (is_text(array)) return text_values<double>(layout, array);
  return type == "Float64" ? stored_values<double, double>(layout, array) : stored_values<float, double>(layout, array);
}

std::vector<std::int64_t> vtu_integers(const VtuLayout& layout, const VtuArray& array) {
  const std::string_view type = attribute(array.attributes, "type");
  using Read = std::vector<std::int64_t> (*)(const VtuLayout&, const VtuArray&);
  constexpr std::pair<std::string_view, Read> readers[] = {
      {"Int8", stored_values<std::int8_t, std::int64_t>},   {"UInt8", stored_values<std::uint8_t, std::int64_t>},
      {"Int16", stored_values<std::int16_t, std::int64_t>}, {"UInt16", stored_values<std::uint16_t, std::int64_t>},
      {"Int32", stored_values<std::int32_t, std::int64_t>}, {"UInt32", stored_values<std::uint32_t, std::int64_t>},
      {"Int64", stored_values<std::int64_t, std::int64_t>}, {"UInt64", stored_values<std::uint64_t, std::int64_t>},
  };
  for (const auto& [name, read] : readers)
    if (name == type) return is_text(array) ? text_values<std::int64_t>(layout, array) : read(layout, array);
  fail_type(layout, array, "Int8 to Int64, UInt8 to UInt64");
}

}  // namespace tessera
