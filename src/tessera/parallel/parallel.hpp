#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "tessera/base/index.hpp"

namespace tessera::parallel {

/// Number of threads in use. Results never depend on it.
int threads();

/// Sets the number of threads; 0 keeps what was set before or what the environment (OMP_NUM_THREADS) says. Throws
/// UsageError when the environment decides and is no number of threads.
void set_threads(int n);

/// Items per block. Sums are taken block by block and then over the blocks in order, so their bits do not depend on the
/// number of threads.
inline constexpr std::int64_t block_size = 1024;

namespace detail {
void run_blocks(std::int64_t blocks, void (*body)(void* context, std::int64_t block), void* context);
/// From now on loops of the calling thread run on it alone.
void keep_to_this_thread();
}  // namespace detail

/// Calls body(begin, end) for consecutive ranges that cover [first, last).
template <class Body>
void for_ranges(std::int64_t first, std::int64_t last, Body&& body) {
  const std::int64_t n = last - first;
  if (n <= 0) return;
  struct Context {
    Body* body;
    std::int64_t first, last;
  } context{&body, first, last};
  detail::run_blocks((n + block_size - 1) / block_size,
                     [](void* p, std::int64_t block) {
                       const Context& c = *static_cast<Context*>(p);
                       const std::int64_t begin = c.first + block * block_size;
                       (*c.body)(begin, std::min(begin + block_size, c.last));
                     },
                     &context);
}

/// Calls body(i) for every i in [0, n); each call may write only what belongs to i.
template <class Body>
void for_each(std::int64_t n, Body&& body) {
  for_ranges(0, n, [&body](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(i);
  });
}

/// Calls body(task) for every task in [0, tasks), each a piece of work about as large as a block.
template <class Body>
void for_tasks(std::int64_t tasks, Body&& body) {
  detail::run_blocks(
      tasks, [](void* p, std::int64_t task) { (*static_cast<std::remove_reference_t<Body>*>(p))(task); },
      const_cast<void*>(static_cast<const void*>(&body)));
}

/// Sums task_value(task) over [0, tasks), the same bits for any number of threads.
template <class T, class TaskValue>
T sum_tasks(std::int64_t tasks, TaskValue&& task_value) {
  std::vector<T> partial(static_cast<std::size_t>(tasks));
  for_tasks(tasks, [&](std::int64_t task) { partial[static_cast<std::size_t>(task)] = task_value(task); });
  T total{};
  for (const T& p : partial) total += p;
  return total;
}

/// Sums range_value(begin, end) over consecutive ranges of [first, last), the same bits for any number of threads.
template <class T, class RangeValue>
T sum_ranges(std::int64_t first, std::int64_t last, RangeValue&& range_value) {
  const std::int64_t n = std::max<std::int64_t>(last - first, 0);
  std::vector<T> partial(static_cast<std::size_t>((n + block_size - 1) / block_size));
  for_ranges(first, last, [&](std::int64_t begin, std::int64_t end) {
    partial[static_cast<std::size_t>((begin - first) / block_size)] = range_value(begin, end);
  });
  T total{};
  for (const T& p : partial) total += p;
  return total;
}

/// Sums value(i) over [0, n), the same bits for any number of threads.
template <class T, class Value>
T sum(std::int64_t n, Value&& value) {
  return sum_ranges<T>(0, n, [&value](std::int64_t begin, std::int64_t end) {
    T s{};
    for (std::int64_t i = begin; i < end; ++i) s += value(i);
    return s;
  });
}

}  // namespace tessera::parallel
