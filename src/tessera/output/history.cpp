#include "tessera/output/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include "tessera/base/error.hpp"
#include "tessera/output/output_file.hpp"

namespace tessera {

namespace {

/// A cell of a CSV file, in quotes when it needs them (RFC 4180).
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted += '"';
  return quoted;
}

/// The first number of a row; nothing when the row does not begin with a number and a comma or its end.
std::optional<double> time_of(std::string_view row) {
  double time = 0.0;
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), time);
  if (error != std::errc() || (end != row.data() + row.size() && *end != ',')) return std::nullopt;
  return time;
}

}  // namespace

History::History(std::string path, std::vector<Column> columns) : path_(std::move(path)), columns_(std::move(columns)) {
  replace_file(path_, header());
  open_at_end();
}

History::History(std::string path, std::vector<Column> columns, const ContinueFrom& from)
    : path_(std::move(path)), columns_(std::move(columns)) {
  replace_file(path_, header() + (std::filesystem::exists(path_) ? kept_rows(from) : ""), Durability::power);
  open_at_end();
}

void History::append(std::span<const double> row) {
  if (row.size() != columns_.size())
    throw std::invalid_argument(
        fmt::format("{}: a row of {} values for {} columns", path_, row.size(), columns_.size()));
  if (last_time_ == row[0]) return;
  fmt::memory_buffer text;
  for (std::size_t i = 0; i < row.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{}{:.17g}", i == 0 ? "" : ",", row[i]);
  text.push_back('\n');
  const bool written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size();
  if (!written || std::fflush(file_.get()) != 0) throw_write_error(path_);
  last_time_ = row[0];
}

std::string History::header() const {
  std::string text;
  for (const Column& column : columns_) {
    if (!text.empty()) text += ',';
    text += csv_cell(fmt::format("{}[{}]", column.name, column.unit));
  }
  return text + "\n";
}

std::string History::kept_rows(const ContinueFrom& from) {
  const std::string content = content_of_file(path_);
  const std::string expected = header();
  if (content.compare(0, expected.size(), expected) != 0)
    throw InputError({path_, 1, 1, ""},
                     "the columns are not those of this case; run the case as it was, or start again");
  const auto commas = std::count(expected.begin(), expected.end(), ',');
  auto line = static_cast<int>(std::count(expected.begin(), expected.end(), '\n'));
  std::size_t begin = expected.size();
  for (std::size_t end = 0; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string_view row(content.data() + begin, end - begin);
    const auto time = time_of(row);
    ++line;
    if (!time || std::count(row.begin(), row.end(), ',') != commas)
      throw InputError({path_, line, 1, ""}, "not a row of this table; remove the line or start the run again");
    if (*time > from.time) break;
    last_time_ = time;
  }
  return content.substr(expected.size(), begin - expected.size());
}

void History::open_at_end() {
  file_.reset(std::fopen(path_.c_str(), "ab"));
  if (!file_) throw_write_error(path_);
}

}  // namespace tessera
