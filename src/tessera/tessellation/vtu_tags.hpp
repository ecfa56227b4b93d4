#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tessera/tessellation/vtu_layout.hpp"

namespace tessera {

enum class VtuTagKind { open, close, empty };

struct VtuTag {
  VtuTagKind kind = VtuTagKind::open;
  std::string_view name;
  VtuAttributes attributes;
  std::size_t line = 0;
};

/// The tags of an XML text one after the other; comments and declarations are passed over. Throws GeometryError with
/// the line for a tag that is not well formed.
class VtuTags {
 public:
  VtuTags(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  /// The next tag; nothing at the end.
  std::optional<VtuTag> next();
  /// What follows the last tag.
  std::string_view rest() const { return bytes_.substr(position_); }
  std::size_t line();

 private:
  [[noreturn]] void fail(const std::string& message);
  void pass_over(std::string_view end);
  void pass_space();
  std::string_view read_name();
  void read_attribute(VtuTag& tag);
  bool starts_with(std::string_view text) const { return bytes_.substr(position_, text.size()) == text; }
  char peek();

  const std::string& path_;
  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t counted_ = 0;  // line breaks before this position are in line_
  std::size_t line_ = 1;
};

}  // namespace tessera
