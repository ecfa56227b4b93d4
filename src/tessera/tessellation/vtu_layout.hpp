#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// The XML attributes of a tag.
using VtuAttributes = std::map<std::string_view, std::string_view, std::less<>>;

/// A DataArray of the points or cells.
struct VtuArray {
  std::string_view parent;  // "Points" or "Cells"
  VtuAttributes attributes;
  std::string_view text;  // what follows the tag, up to the next one
  std::size_t line = 0;
};

/// Where everything is in the bytes of a .vtu file, which must outlive it.
struct VtuLayout {
  std::string path;
  VtuAttributes file;  // of VTKFile
  VtuAttributes piece;
  std::size_t piece_line = 0;
  std::vector<VtuArray> arrays;
  std::string_view appended;  // behind the underscore, to the end of the file
  std::string_view appended_encoding;

  /// Throws GeometryError "path:line: message".
  [[noreturn]] void fail(std::size_t line, const std::string& message) const;
};

/// The attribute's value, or `otherwise` where it is missing.
std::string_view attribute(const VtuAttributes& attributes, std::string_view name, std::string_view otherwise = "");

/// Reads the tags. Knows as much XML as VTK writes: tags, attributes, comments, declarations; no entities. Throws
/// GeometryError with the line for anything else, for a file that is no unstructured grid, and for one in several
/// pieces.
VtuLayout scan_vtu(const std::string& path, std::string_view bytes);

}  // namespace tessera
