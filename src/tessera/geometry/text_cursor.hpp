#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tessera {

/// A place in the bytes of a text file, and the words and numbers that follow it. Every reading function throws
/// GeometryError with file and line when the file ends or holds something else.
class TextCursor {
 public:
  /// From `comment` to the end of a line nothing is read; 0 for files without comments.
  TextCursor(const std::string& path, std::string_view bytes, char comment)
      : path_(path), bytes_(bytes), comment_(comment) {}

  /// The next word, if need be on another line.
  std::string_view word();
  /// The next word without moving on; empty at the end of the file.
  std::string_view peek();
  /// Fails where lines end in carriage returns alone, which makes one line of all: for formats in which lines count.
  void require_line_feeds() const;
  /// Reads the word `expected`, in capitals or not.
  void expect(std::string_view expected);
  double number();
  std::int64_t integer();
  /// Not below zero, and no more than the rest of the file can hold of things (`what`) of at least `least_bytes` each.
  std::size_t count(std::string_view what, std::size_t least_bytes);

  bool at_end() { return peek().empty(); }
  /// Is nothing but blanks and a comment left on this line?
  bool at_line_end();
  /// The rest of this line without blanks at its ends, comments included.
  std::string_view rest_of_line();
  void skip_line() { rest_of_line(); }
  std::size_t bytes_left() const { return bytes_.size() - position_; }
  /// Where the cursor stands, in bytes from the beginning.
  std::size_t position() const { return position_; }

  /// Line of the last word that was read, from one.
  std::int64_t line() const { return word_line_; }
  /// Line of the next word.
  std::int64_t next_line() { return peek(), line_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_blanks();
  void skip_space();
  [[noreturn]] void fail_at_word(std::string_view kind, std::string_view found) const;

  const std::string& path_;
  std::string_view bytes_;
  char comment_;
  std::size_t position_ = 0;
  std::int64_t line_ = 1, word_line_ = 1;
};

/// Without the mark that some editors put in front of a text to tell its encoding.
std::string_view without_byte_order_mark(std::string_view text);

/// The beginning of `text` as an error message may show it: in quotes, without control characters.
std::string excerpt(std::string_view text);

/// Are two words the same but for capitals?
bool same_word(std::string_view a, std::string_view b);

}  // namespace tessera
