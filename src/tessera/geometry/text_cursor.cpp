#include "tessera/geometry/text_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "tessera/base/error.hpp"
#include "tessera/base/text.hpp"
#include "tessera/geometry/file_place.hpp"

namespace tessera {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
bool is_space(char c) { return is_blank(c) || c == '\n'; }

/// Numbers that from_chars finds too large or too small: infinite or zero.
double out_of_range(std::string_view word) { return std::strtod(std::string(word).c_str(), nullptr); }

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

bool same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::string excerpt(std::string_view text) {
  std::string beginning(text.substr(0, 40));
  std::replace_if(
      beginning.begin(), beginning.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return quoted(beginning);
}

void TextCursor::skip_blanks() {
  for (; position_ < bytes_.size(); ++position_) {
    const char c = bytes_[position_];
    const std::size_t next = position_ + 1;
    if (c == '\\' && comment_ != 0 && next < bytes_.size() && (bytes_[next] == '\n' || bytes_[next] == '\r')) {
      // A backslash joins this line to the next.
      position_ = std::min(bytes_.find('\n', next), bytes_.size() - 1);
      ++line_;
    } else if (comment_ != 0 && c == comment_) {
      position_ = std::min(bytes_.find('\n', position_), bytes_.size());
      return;
    } else if (!is_blank(c)) {
      return;
    }
  }
}

void TextCursor::skip_space() {
  for (skip_blanks(); position_ < bytes_.size() && bytes_[position_] == '\n'; skip_blanks()) {
    ++position_;
    ++line_;
  }
}

std::string_view TextCursor::peek() {
  skip_space();
  std::size_t end = position_;
  while (end < bytes_.size() && !is_space(bytes_[end])) ++end;
  return bytes_.substr(position_, end - position_);
}

std::string_view TextCursor::word() {
  const std::string_view next = peek();
  word_line_ = line_;
  if (next.empty()) {
    require_line_feeds();
    fail("the file ends too early: it is truncated; write it again");
  }
  position_ += next.size();
  return next;
}

void TextCursor::require_line_feeds() const {
  if (bytes_.find('\n') == std::string_view::npos && bytes_.find('\r') != std::string_view::npos)
    fail("the file is one line: its lines end in carriage returns alone; write it again with line feeds");
}

void TextCursor::expect(std::string_view expected) {
  const std::string_view found = word();
  if (!same_word(found, expected)) fail_at_word(fmt::format("\"{}\"", expected), found);
}

double TextCursor::number() {
  const std::string_view found = word();
  const char* begin = found.data() + (found.front() == '+' ? 1 : 0);
  const char* end = found.data() + found.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || error == std::errc::invalid_argument) fail_at_word("a number", found);
  return error == std::errc() ? value : out_of_range(found);
}

std::int64_t TextCursor::integer() {
  const std::string_view found = word();
  const char* begin = found.data() + (found.front() == '+' ? 1 : 0);
  const char* end = found.data() + found.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || error != std::errc()) fail_at_word("an integer", found);
  return value;
}

std::size_t TextCursor::count(std::string_view what, std::size_t least_bytes) {
  const std::int64_t value = integer();
  const std::size_t most = bytes_left() / least_bytes;
  if (value < 0 || static_cast<std::uint64_t>(value) > most)
    fail(
        fmt::format("{} {} are announced, but the rest of the file has room for {} at most: it is truncated or "
                    "damaged; write it again",
                    value, what, most));
  return static_cast<std::size_t>(value);
}

bool TextCursor::at_line_end() {
  skip_blanks();
  return position_ >= bytes_.size() || bytes_[position_] == '\n';
}

std::string_view TextCursor::rest_of_line() {
  std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
  std::string_view rest = bytes_.substr(position_, end - position_);
  position_ = end;
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  return rest;
}

void TextCursor::fail(const std::string& message) const {
  throw GeometryError(locate(path_, PlaceUnit::line, word_line_) + message);
}

void TextCursor::fail_at_word(std::string_view kind, std::string_view found) const {
  fail(fmt::format("{} is expected here, found {}: the file is damaged or of another kind; write it again", kind,
                   excerpt(found)));
}

}  // namespace tessera
