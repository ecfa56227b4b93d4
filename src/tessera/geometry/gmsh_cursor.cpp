#include "tessera/geometry/gmsh_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

int GmshCursor::read_int() {
  return encoding_ == GmshEncoding::ascii ? read_text<int>("an integer") : read_binary<int>();
}

std::int64_t GmshCursor::read_long() {
  return encoding_ == GmshEncoding::ascii ? read_text<std::int64_t>("an integer") : read_binary<std::int64_t>();
}

double GmshCursor::read_double() {
  return encoding_ == GmshEncoding::ascii ? read_text<double>("a number") : read_binary<double>();
}

std::int64_t GmshCursor::read_text_long() { return read_text<std::int64_t>("an integer"); }

std::size_t GmshCursor::check_count(std::int64_t count, std::size_t least_bytes, std::string_view what) {
  const std::size_t most = std::min<std::size_t>((bytes_.size() - position_) / least_bytes,
                                                 static_cast<std::size_t>(std::numeric_limits<Index>::max()));
  if (count < 0 || static_cast<std::uint64_t>(count) > most)
    fail(fmt::format(
        "{} {} are announced, but the rest of the file has room for {} at most: the file is truncated or damaged; "
        "write it again",
        count, what, most));
  return static_cast<std::size_t>(count);
}

void GmshCursor::skip_doubles(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) read_double();
}

std::string_view GmshCursor::read_word() {
  skip_space();
  last_ = position_;
  if (at_end()) fail("the file ends too early: it is truncated; write it again");
  const std::size_t begin = position_;
  while (!at_end() && !is_space(bytes_[position_])) ++position_;
  return bytes_.substr(begin, position_ - begin);
}

std::string GmshCursor::read_quoted() {
  skip_space();
  last_ = position_;
  const std::size_t begin = position_;
  const std::size_t end = at_end() || bytes_[begin] != '"' ? std::string_view::npos : bytes_.find('"', begin + 1);
  if (end == std::string_view::npos) fail("a name in double quotes is missing");
  position_ = end + 1;
  return std::string(bytes_.substr(begin + 1, end - begin - 1));
}

void GmshCursor::skip_to_next_line() {
  while (!at_end() && bytes_[position_] != '\n') ++position_;
  if (!at_end()) ++position_;
}

void GmshCursor::expect_line_end() {
  if (encoding_ == GmshEncoding::binary) return;
  while (!at_end() && is_space(bytes_[position_]) && bytes_[position_] != '\n') ++position_;
  last_ = position_;
  if (!at_end() && bytes_[position_] != '\n')
    fail("this line or the one before has too many or too few numbers: the file is damaged; write it again");
}

void GmshCursor::skip_space() {
  while (!at_end() && is_space(bytes_[position_])) ++position_;
}

void GmshCursor::skip_section(std::string_view name) {
  const std::string end = fmt::format("\n$End{}", name);
  const std::size_t found = bytes_.find(end, position_ > 0 ? position_ - 1 : 0);
  if (found == std::string_view::npos)
    fail(fmt::format("the section ${0} has no $End{0}: the file is truncated; write it again", name));
  position_ = found + end.size();
}

void GmshCursor::expect(std::string_view word) {
  skip_space();
  last_ = position_;
  if (bytes_.substr(position_, word.size()) != word)
    fail(fmt::format(
        "{} is missing here: the section's counts are wrong, or the file is damaged or truncated; write it again",
        word));
  position_ += word.size();
}

std::int64_t GmshCursor::place() {
  if (encoding_ == GmshEncoding::ascii) skip_space();
  return place_of(position_);
}

std::int64_t GmshCursor::place_of(std::size_t position) {
  if (encoding_ == GmshEncoding::binary) return static_cast<std::int64_t>(position) + 1;
  if (position < counted_position_) counted_position_ = 0, line_ = 1;
  line_ += std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(counted_position_),
                      bytes_.begin() + static_cast<std::ptrdiff_t>(position), '\n');
  counted_position_ = position;
  return line_;
}

void GmshCursor::fail(std::string_view message) {
  std::string text(message);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  throw GeometryError(locate(path_, unit(), place_of(last_)) + text);
}

template <class T>
T GmshCursor::read_binary() {
  last_ = position_;
  if (bytes_.size() - position_ < sizeof(T)) fail("the file ends too early: it is truncated; write it again");
  T value;
  std::memcpy(&value, bytes_.data() + position_, sizeof(T));
  position_ += sizeof(T);
  return value;
}

template <class T>
T GmshCursor::read_text(std::string_view kind) {
  const std::string_view word = read_word();
  const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
  const char* end = word.data() + word.size();
  T value{};
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc() && stop == end) return value;
  fail(fmt::format("{} is expected here, found \"{}\": the file is damaged or truncated; write it again", kind,
                   word.substr(0, 40)));
}

}  // namespace tessera
