#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "tessera/geometry/surface_reader.hpp"
#include "tessera/geometry/text_cursor.hpp"

namespace tessera {
namespace {

/// The ways in which a file may group its faces.
constexpr std::array<std::string_view, 3> kGroupings{"g", "usemtl", "o"};
/// What says nothing about places and faces: texture, normals, shading, materials, points and lines.
constexpr std::array<std::string_view, 8> kPassedOver{"vt", "vn", "s", "mtllib", "l", "p", "lod", "shadow_obj"};

template <std::size_t n>
std::size_t find_word(const std::array<std::string_view, n>& words, std::string_view word) {
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
}

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view bytes)
      : cursor_(path, without_byte_order_mark(bytes), '#'), builder_(path, PlaceUnit::line) {}

  FileSurface read() {
    cursor_.require_line_feeds();
    while (!cursor_.at_end()) read_statement();
    name_sides();
    return std::move(builder_.file());
  }

 private:
  void read_statement() {
    const std::string_view word = cursor_.word();
    if (word == "v") {
      const double x = cursor_.number(), y = cursor_.number(), z = cursor_.number();
      builder_.add_vertex({x, y, z});
      return cursor_.skip_line();  // a weight or a colour
    }
    if (word == "f") return read_face();
    if (const std::size_t i = find_word(kGroupings, word); i < kGroupings.size()) {
      now_[i] = number_of(i, cursor_.rest_of_line());
      return;
    }
    if (find_word(kPassedOver, word) < kPassedOver.size()) return skip_statement();
    cursor_.fail(
        fmt::format("the statement {} cannot be used: polygons (v, f) with groups (o, g, usemtl) are read, no "
                    "free-form curves and surfaces",
                    excerpt(word)));
  }

  void skip_statement() {
    while (!cursor_.at_line_end()) cursor_.word();
  }

  Index number_of(std::size_t grouping, std::string_view name) {
    std::vector<std::string>& names = names_[grouping];
    const auto place = std::find(names.begin(), names.end(), name) - names.begin();
    if (place == static_cast<std::ptrdiff_t>(names.size())) names.emplace_back(name);
    return static_cast<Index>(place);
  }

  /// "7", "7/1", "7//2" or "7/1/2": only the vertex counts. Negative numbers count back from the last vertex.
  Index read_corner() {
    const std::string_view word = cursor_.word();
    const std::string_view digits = word.substr(0, word.find('/'));
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || stop != digits.data() + digits.size())
      cursor_.fail(fmt::format("the number of a vertex is expected here, found {}", excerpt(word)));
    const std::int64_t index = number < 0 ? builder_.vertices() + number : number - 1;
    if (index < 0 || index >= builder_.vertices())
      cursor_.fail(fmt::format("there is no vertex {}: {} were given above this line, counted from 1 (or back from -1)",
                               number, builder_.vertices()));
    return static_cast<Index>(index);
  }

  void read_face() {
    const std::int64_t line = cursor_.line();
    corners_.clear();
    while (!cursor_.at_line_end()) corners_.push_back(read_corner());
    builder_.add_polygon(corners_, 0, line);
    groups_.resize(builder_.file().surface.triangles.size(), now_);
  }

  /// Of the three groupings the one that tells most faces apart makes the sides.
  void name_sides() {
    std::array<std::size_t, 3> used{};
    for (std::size_t i = 0; i < kGroupings.size(); ++i) {
      std::vector<bool> is_used(names_[i].size() + 1, false);
      for (const auto& group : groups_) is_used[static_cast<std::size_t>(group[i] + 1)] = true;
      used[i] = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), true));
      if (names_[i].empty()) used[i] = 0;
    }
    const auto best = static_cast<std::size_t>(std::max_element(used.begin(), used.end()) - used.begin());
    std::vector<Index>& side = builder_.file().surface.side;
    for (std::size_t t = 0; t < side.size(); ++t) {
      const Index group = used[best] == 0 ? -1 : groups_[t][best];
      const std::string_view name = group < 0 ? kNamelessSide : names_[best][static_cast<std::size_t>(group)];
      side[t] = builder_.side(name.empty() ? kNamelessSide : name);
    }
  }

  TextCursor cursor_;
  FileSurfaceBuilder builder_;
  std::array<std::vector<std::string>, 3> names_;  // per grouping
  std::array<Index, 3> now_{-1, -1, -1};           // per grouping: what holds for the next faces
  std::vector<std::array<Index, 3>> groups_;       // per triangle
  std::vector<Index> corners_;
};

}  // namespace

FileSurface read_obj(const std::string& path, std::string_view bytes) { return ObjReader(path, bytes).read(); }

}  // namespace tessera
