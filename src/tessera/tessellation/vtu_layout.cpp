#include "tessera/tessellation/vtu_layout.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tessera/base/error.hpp"
#include "tessera/tessellation/vtu_tags.hpp"

namespace tessera {
namespace {

std::string_view leading_text(std::string_view rest) { return rest.substr(0, rest.find('<')); }

/// Follows the tags and writes down what matters on the way.
class Scanner {
 public:
  Scanner(VtuLayout& layout, std::string_view bytes) : layout_(layout), tags_(layout.path, bytes) {}

  void scan() {
    while (const std::optional<VtuTag> tag = tags_.next()) {
      if (tag->kind == VtuTagKind::close) {
        close(*tag);
        continue;
      }
      open(*tag);
      if (tag->name == "AppendedData") return;  // what follows need not be XML
      if (tag->kind == VtuTagKind::open) path_.push_back(tag->name);
    }
    if (!path_.empty())
      layout_.fail(tags_.line(),
                   fmt::format("<{}> is never closed: the file is truncated; write it again", path_.back()));
  }

 private:
  void close(const VtuTag& tag) {
    if (path_.empty() || path_.back() != tag.name)
      layout_.fail(tag.line, fmt::format("</{}> closes nothing: the file is damaged; write it again", tag.name));
    path_.pop_back();
  }

  void open(const VtuTag& tag) {
    if (path_.empty())
      open_file(tag);
    else if (tag.name == "Piece")
      open_piece(tag);
    else if (tag.name == "AppendedData")
      open_appended(tag);
    else if (tag.name == "DataArray" && (path_.back() == "Points" || path_.back() == "Cells"))
      layout_.arrays.push_back({path_.back(), tag.attributes, leading_text(tags_.rest()), tag.line});
  }

  void open_file(const VtuTag& tag) {
    if (tag.name != "VTKFile" || attribute(tag.attributes, "type") != "UnstructuredGrid")
      layout_.fail(tag.line, "is no VTK unstructured grid: <VTKFile type=\"UnstructuredGrid\"> is expected");
    layout_.file = tag.attributes;
  }

  void open_piece(const VtuTag& tag) {
    if (layout_.piece_line != 0) layout_.fail(tag.line, "a second piece: write the grid in one piece (merge it first)");
    layout_.piece = tag.attributes;
    layout_.piece_line = tag.line;
  }

  void open_appended(const VtuTag& tag) {
    layout_.appended_encoding = attribute(tag.attributes, "encoding", "base64");
    const std::size_t mark = tags_.rest().find('_');
    if (mark == std::string_view::npos)
      layout_.fail(tag.line, "the appended data do not begin with an underscore: the file is damaged; write it again");
    layout_.appended = tags_.rest().substr(mark + 1);
  }

  VtuLayout& layout_;
  VtuTags tags_;
  std::vector<std::string_view> path_;
};

}  // namespace

void VtuLayout::fail(std::size_t line, const std::string& message) const {
  std::string text = message;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  throw GeometryError(fmt::format("{}:{}: {}", path, line, text));
}

std::string_view attribute(const VtuAttributes& attributes, std::string_view name, std::string_view otherwise) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? otherwise : found->second;
}

VtuLayout scan_vtu(const std::string& path, std::string_view bytes) {
  VtuLayout layout;
  layout.path = path;
  Scanner(layout, bytes).scan();
  if (layout.file.empty())
    layout.fail(1, "is no VTK unstructured grid: <VTKFile type=\"UnstructuredGrid\"> is expected");
  if (layout.piece_line == 0) layout.fail(1, "has no <Piece>: write the grid again");
  return layout;
}

}  // namespace tessera
