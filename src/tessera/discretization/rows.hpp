#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// The entries of one row while it is put together; the same column may be added several times.
class RowBuffer {
 public:
  void clear() {
    columns_.clear();
    entries_.clear();
  }

  /// Sums equal columns in the order in which they are added. Rows are so short that a search takes no time.
  void add(Index column, const Vec3& B) {
    const auto at = static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), column) - columns_.begin());
    if (at == columns_.size()) {
      columns_.push_back(column);
      entries_.push_back({column, {}});
    }
    entries_[at].sum += B;
  }

  /// Hands out ascending columns.
  template <class Take>
  void drain(Take&& take) {
    std::sort(entries_.begin(), entries_.end(), [](const Entry& l, const Entry& r) { return l.column < r.column; });
    for (const Entry& e : entries_) take(e.column, e.sum);
    clear();
  }

 private:
  struct Entry {
    Index column;
    Vec3 sum;
  };
  std::vector<Index> columns_;  // in the order of the entries
  std::vector<Entry> entries_;
};

/// B_aa = - sum_b B_ab - sum_f B_af, [D 29], [V 9].
std::vector<Vec3> diagonal_vectors(const Discretization& d);

/// Is the projection zero (no component constrained), or the identity (all of them)?
bool is_zero(const Mat3& D);
bool is_identity(const Mat3& D);

}  // namespace tessera
