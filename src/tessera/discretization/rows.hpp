#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// The entries of one row while it is put together; the same column may be added several times.
class RowBuffer {
 public:
  void clear() { entries_.clear(); }
  void add(Index column, const Vec3& B) { entries_.push_back({column, B}); }

  /// Sums equal columns (in the order in which they were added) and hands out ascending columns.
  template <class Take>
  void drain(Take&& take) {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& l, const Entry& r) { return l.column < r.column; });
    for (std::size_t i = 0; i < entries_.size();) {
      const Index column = entries_[i].column;
      Vec3 sum;
      for (; i < entries_.size() && entries_[i].column == column; ++i) sum += entries_[i].B;
      take(column, sum);
    }
    clear();
  }

 private:
  struct Entry {
    Index column;
    Vec3 B;
  };
  std::vector<Entry> entries_;
};

/// B_aa = - sum_b B_ab - sum_f B_af, [D 29], [V 9].
std::vector<Vec3> diagonal_vectors(const Discretization& d);

/// Is the projection zero (no component constrained), or the identity (all of them)?
bool is_zero(const Mat3& D);
bool is_identity(const Mat3& D);

}  // namespace tessera
