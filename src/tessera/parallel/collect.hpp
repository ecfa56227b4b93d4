#pragma once

#include <vector>

#include "tessera/base/csr.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera::parallel {

/// Takes the values of consecutive rows.
template <class T>
class RowCollector {
 public:
  void add(const T& value) { values_.push_back(value); }
  void end_row() { ends_.push_back(static_cast<Offset>(values_.size())); }
  const std::vector<T>& values() const { return values_; }
  const std::vector<Offset>& ends() const { return ends_; }
  void release() { *this = RowCollector(); }

 private:
  std::vector<T> values_;
  std::vector<Offset> ends_;
};

/// Makes the rows of a Csr in parallel: `make(row, collector)` adds the values of one row. The result does not depend
/// on the number of threads.
template <class T, class Make>
Csr<T> collect_rows(Index rows, Make&& make) {
  const std::int64_t blocks = (static_cast<std::int64_t>(rows) + block_size - 1) / block_size;
  std::vector<RowCollector<T>> parts(static_cast<std::size_t>(blocks));
  for_ranges(0, rows, [&](std::int64_t begin, std::int64_t end) {
    RowCollector<T>& part = parts[static_cast<std::size_t>(begin / block_size)];
    for (auto row = static_cast<Index>(begin); row < static_cast<Index>(end); ++row) {
      make(row, part);
      part.end_row();
    }
  });

  std::vector<Offset> first(parts.size() + 1, 0);
  for (std::size_t b = 0; b < parts.size(); ++b)
    first[b + 1] = first[b] + static_cast<Offset>(parts[b].values().size());
  Csr<T> csr;
  csr.offset.resize(static_cast<std::size_t>(rows) + 1);
  csr.value.resize(static_cast<std::size_t>(first.back()));
  for_ranges(0, rows, [&](std::int64_t begin, std::int64_t) {
    const auto b = static_cast<std::size_t>(begin / block_size);
    std::copy(parts[b].values().begin(), parts[b].values().end(), csr.value.begin() + first[b]);
    for (std::size_t i = 0; i < parts[b].ends().size(); ++i)
      csr.offset[static_cast<std::size_t>(begin) + i + 1] = first[b] + parts[b].ends()[i];
    parts[b].release();
  });
  return csr;
}

}  // namespace tessera::parallel
