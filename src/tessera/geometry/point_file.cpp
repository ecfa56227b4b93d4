#include "tessera/geometry/point_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "tessera/base/text.hpp"

namespace tessera {
namespace {

constexpr std::array<std::string_view, 4> kColumns{"x", "y", "z", "radius"};
constexpr std::size_t kRadius = 3;

struct Field {
  std::string_view text;
  int column = 1;  // of its first character, counted from one
};

std::vector<Field> split(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view text = trimmed(line.substr(begin, end - begin));
    const std::size_t first = text.empty() ? begin : static_cast<std::size_t>(text.data() - line.data());
    fields.push_back({text, static_cast<int>(first) + 1});
    begin = end + 1;
  }
  return fields;
}

class Reader {
 public:
  Reader(const PointFileSpec& spec, const Origin& origin) : path_(spec.path), file_(spec.path) {
    if (!file_) throw InputError(origin, fmt::format("cannot read the point file '{}'", path_));
  }

  FilePoints read() {
    while (std::getline(file_, line_)) {
      ++number_;
      if (number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.erase(0, 3);  // byte order mark
      if (line_.ends_with('\r')) line_.pop_back();
      if (trimmed(line_).empty()) continue;
      has_header_ ? read_point() : read_header();
    }
    if (file_.bad()) fail(1, "the file could not be read to its end");
    if (!has_header_) fail(1, "the file is empty; its first line must be the header x,y,z");
    if (result_.points.empty()) fail(1, "the file holds no points, only a header");
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(int column, const std::string& message) const {
    throw InputError({path_, number_ == 0 ? 1 : number_, column, ""}, message);
  }

  void read_header() {
    for (const Field& field : split(line_)) {
      const auto name = std::find(kColumns.begin(), kColumns.end(), field.text);
      if (name == kColumns.end())
        fail(field.column,
             fmt::format("unknown column '{}'; the header must be x,y,z or x,y,z,radius (in any order, nothing else)",
                         field.text));
      const auto column = static_cast<std::size_t>(name - kColumns.begin());
      if (std::find(columns_.begin(), columns_.end(), column) != columns_.end())
        fail(field.column, fmt::format("column '{}' appears twice", field.text));
      columns_.push_back(column);
    }
    has_radius_ = std::find(columns_.begin(), columns_.end(), kRadius) != columns_.end();
    if (columns_.size() != (has_radius_ ? 4U : 3U)) fail(1, "the header must name the three columns x,y,z");
    has_header_ = true;
  }

  void read_point() {
    const std::vector<Field> fields = split(line_);
    if (fields.size() != columns_.size())
      fail(1, fmt::format("found {} fields, expected {}", fields.size(), columns_.size()));
    Vec3 X;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i] == kRadius)
        result_.radius.push_back(radius(fields[i]));
      else
        X[static_cast<int>(columns_[i])] = number(fields[i]);
    result_.points.push_back(X);
    result_.lines.push_back(number_);
  }

  double number(const Field& field) const {
    double value = 0.0;
    const std::string_view digits = field.text.starts_with('+') ? field.text.substr(1) : field.text;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      fail(field.column, fmt::format("'{}' is not a finite number (coordinates are in metres)", field.text));
    return value;
  }

  double radius(const Field& field) const {
    const double value = number(field);
    if (value < 0.0) fail(field.column, fmt::format("the radius {} is negative", field.text));
    return value;
  }

  std::string path_;
  std::ifstream file_;
  std::string line_;
  int number_ = 0;
  bool has_header_ = false;
  std::vector<std::size_t> columns_;  // what each column holds, as a place in kColumns
  bool has_radius_ = false;
  FilePoints result_;
};

}  // namespace

FilePoints read_points(const PointFileSpec& spec, const Origin& origin) { return Reader(spec, origin).read(); }

}  // namespace tessera
