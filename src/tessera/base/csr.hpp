#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "tessera/base/index.hpp"

namespace tessera {

/// Rows of different lengths in one contiguous array (compressed sparse rows).
template <class T>
struct Csr {
  std::vector<Offset> offset{0};
  std::vector<T> value;

  Index rows() const { return static_cast<Index>(offset.size()) - 1; }
  Offset begin(Index row) const { return offset[static_cast<std::size_t>(row)]; }
  Offset end(Index row) const { return offset[static_cast<std::size_t>(row) + 1]; }
  std::span<T> row(Index r) { return {value.data() + begin(r), static_cast<std::size_t>(end(r) - begin(r))}; }
  std::span<const T> row(Index r) const {
    return {value.data() + begin(r), static_cast<std::size_t>(end(r) - begin(r))};
  }
};

/// Sorts `items` into rows by `row_of(item)`, keeping their order within a row.
template <class T, class RowOf>
Csr<T> group_by_row(Index rows, std::span<const T> items, RowOf row_of) {
  Csr<T> csr;
  csr.offset.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const T& item : items) ++csr.offset[static_cast<std::size_t>(row_of(item)) + 1];
  for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r) csr.offset[r + 1] += csr.offset[r];
  std::vector<Offset> next(csr.offset.begin(), csr.offset.end() - 1);
  csr.value.resize(items.size());
  for (const T& item : items)
    csr.value[static_cast<std::size_t>(next[static_cast<std::size_t>(row_of(item))]++)] = item;
  return csr;
}

/// An item and the number of the row that it belongs to.
template <class T>
struct RowItem {
  Index row = 0;
  T item;
};

/// The same where few rows have items: `rows` names those that have, ascending, and the result holds one row for each.
template <class T>
Csr<T> group_by_used_row(std::vector<RowItem<T>> items, std::vector<Index>& rows) {
  std::stable_sort(items.begin(), items.end(), [](const RowItem<T>& l, const RowItem<T>& r) { return l.row < r.row; });
  rows.clear();
  Csr<T> csr;
  for (const RowItem<T>& i : items) {
    if (rows.empty() || rows.back() != i.row) {
      rows.push_back(i.row);
      csr.offset.push_back(csr.offset.back());
    }
    csr.value.push_back(i.item);
    ++csr.offset.back();
  }
  return csr;
}

}  // namespace tessera
