#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tessera/geometry/mesh_file.hpp"

namespace tessera {

enum class GmshEncoding { ascii, binary };

/// A place in the bytes of a Gmsh file, and the numbers that follow it, as text or in binary.
/// Every reading function throws GeometryError with the place when the file ends or holds something else.
class GmshCursor {
 public:
  GmshCursor(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  /// How numbers are written from here on; section names and $PhysicalNames are text in both.
  void set_encoding(GmshEncoding encoding) { encoding_ = encoding; }
  GmshEncoding encoding() const { return encoding_; }

  int read_int();
  /// A size_t of the format: 8 bytes in binary.
  std::int64_t read_long();
  double read_double();
  /// An integer written as text, whatever the encoding.
  std::int64_t read_text_long();
  /// `count`, or an error when the rest of the file cannot hold so many things (`what`) of at least `least_bytes`
  /// each: so memory may be set aside for them.
  std::size_t check_count(std::int64_t count, std::size_t least_bytes, std::string_view what);
  void skip_doubles(std::size_t count);

  /// A whitespace-separated word, also in a binary file.
  std::string_view read_word();
  /// A text in double quotes.
  std::string read_quoted();
  void skip_to_next_line();
  /// In ASCII, nothing but blanks may follow on this line.
  void expect_line_end();
  void skip_space();
  bool at_end() const { return position_ >= bytes_.size(); }
  /// Moves behind the line "$EndNAME".
  void skip_section(std::string_view name);
  /// Reads the word `word`.
  void expect(std::string_view word);

  /// Line or byte of the next number, from one.
  std::int64_t place();
  PlaceUnit unit() const { return encoding_ == GmshEncoding::ascii ? PlaceUnit::line : PlaceUnit::byte; }
  /// Throws GeometryError at the last number or word that was read.
  [[noreturn]] void fail(std::string_view message);

 private:
  std::int64_t place_of(std::size_t position);
  template <class T>
  T read_binary();
  template <class T>
  T read_text(std::string_view kind);

  const std::string& path_;
  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;              // where the last number or word began
  std::size_t counted_position_ = 0;  // the line breaks before this one have been counted
  std::int64_t line_ = 1;
  GmshEncoding encoding_ = GmshEncoding::ascii;
};

}  // namespace tessera
