#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tessera/output/frame_index.hpp"

namespace tessera {

/// A column of a table: what it holds and its unit ("-" for pure numbers).
struct Column {
  std::string name;
  std::string unit;

  friend bool operator==(const Column&, const Column&) = default;
};

/// A table that grows row by row, a CSV file: header `t[s],kinetic[J],..`, numbers with 17 digits. The first column is
/// the time. Each row reaches the operating system at once, so a killed run leaves whole rows.
class History {
 public:
  /// Begins the table. Throws RunError, as append() does, when the file cannot be written.
  History(std::string path, std::vector<Column> columns);
  /// Goes on with a table: rows after from.time and a last row without its line end are dropped; a missing
  /// table begins anew. Throws InputError when the file has other columns or is no table.
  History(std::string path, std::vector<Column> columns, const ContinueFrom& from);

  /// Adds a row, one value per column; does nothing when the last row has the same time.
  void append(std::span<const double> row);

  /// Time of the last row [s].
  std::optional<double> last_time() const { return last_time_; }
  const std::vector<Column>& columns() const { return columns_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string header() const;
  std::string kept_rows(const ContinueFrom& from);
  void open_at_end();

  std::string path_;
  std::vector<Column> columns_;
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<double> last_time_;
};

}  // namespace tessera
