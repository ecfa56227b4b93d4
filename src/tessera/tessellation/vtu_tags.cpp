#include "tessera/tessellation/vtu_tags.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == ':' || c == '.';
}

}  // namespace

std::optional<VtuTag> VtuTags::next() {
  for (;;) {
    position_ = std::min(bytes_.find('<', position_), bytes_.size());
    if (position_ == bytes_.size()) return std::nullopt;
    if (starts_with("<!--"))
      pass_over("-->");
    else if (starts_with("<?"))
      pass_over("?>");
    else if (starts_with("<!"))
      pass_over(">");
    else
      break;
  }
  VtuTag tag;
  tag.line = line();
  ++position_;
  if (peek() == '/') tag.kind = VtuTagKind::close, ++position_;
  tag.name = read_name();
  for (pass_space(); peek() != '>' && peek() != '/'; pass_space()) read_attribute(tag);
  if (peek() == '/') tag.kind = VtuTagKind::empty, ++position_;
  if (peek() != '>') fail("\">\" is expected here: the tag is damaged; write the file again");
  ++position_;
  return tag;
}

std::size_t VtuTags::line() {
  line_ += static_cast<std::size_t>(std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                               bytes_.begin() + static_cast<std::ptrdiff_t>(position_), '\n'));
  counted_ = position_;
  return line_;
}

void VtuTags::fail(const std::string& message) {
  throw GeometryError(fmt::format("{}:{}: {}", path_, line(), message));
}

void VtuTags::pass_over(std::string_view end) {
  const std::size_t found = bytes_.find(end, position_);
  if (found == std::string_view::npos)
    fail(fmt::format("\"{}\" is missing: the file is truncated; write it again", end));
  position_ = found + end.size();
}

void VtuTags::pass_space() {
  while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
}

char VtuTags::peek() {
  if (position_ >= bytes_.size()) fail("the file ends inside a tag: it is truncated; write it again");
  return bytes_[position_];
}

std::string_view VtuTags::read_name() {
  const std::size_t begin = position_;
  while (position_ < bytes_.size() && is_name(bytes_[position_])) ++position_;
  if (position_ == begin) fail("a name is expected here: the tag is damaged; write the file again");
  return bytes_.substr(begin, position_ - begin);
}

void VtuTags::read_attribute(VtuTag& tag) {
  const std::string_view name = read_name();
  pass_space();
  if (peek() != '=') fail("\"=\" is expected here: the tag is damaged; write the file again");
  ++position_;
  pass_space();
  const char quote = peek();
  const std::size_t end = quote == '"' || quote == '\'' ? bytes_.find(quote, position_ + 1) : std::string_view::npos;
  if (end == std::string_view::npos)
    fail("a value in quotes is expected here: the tag is damaged; write the file again");
  tag.attributes[name] = bytes_.substr(position_ + 1, end - position_ - 1);
  position_ = end + 1;
}

}  // namespace tessera
