#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "tessera/parallel/parallel.hpp"

namespace tessera::parallel {

/// Sorts by `before`, which must leave no two items equal if their order is to be certain. The result does not depend
/// on the number of threads.
template <class T, class Before = std::less<>>
void sort(std::vector<T>& items, Before before = {}) {
  constexpr std::int64_t run = 16 * block_size;  // sorted at once, then merged two by two
  const auto n = static_cast<std::int64_t>(items.size());
  const auto at = [n](std::vector<T>& v, std::int64_t i) { return v.begin() + std::min(i, n); };
  for_tasks((n + run - 1) / run,
            [&](std::int64_t i) { std::sort(at(items, i * run), at(items, (i + 1) * run), before); });
  if (n <= run) return;
  std::vector<T> merged(items.size());
  for (std::int64_t length = run; length < n; length *= 2) {
    for_tasks((n + 2 * length - 1) / (2 * length), [&](std::int64_t i) {
      const std::int64_t first = 2 * i * length;
      std::merge(at(items, first), at(items, first + length), at(items, first + length), at(items, first + 2 * length),
                 at(merged, first), before);
    });
    std::swap(items, merged);
  }
}

}  // namespace tessera::parallel
