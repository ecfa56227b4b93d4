#include "tessera/parallel/pool.hpp"

#include <algorithm>
#include <utility>

namespace tessera::parallel {

namespace {

// A few microseconds: sweeps follow each other closely, and a sleeping thread takes longer than that to wake.
constexpr int spins = 4000;

inline void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Returns when `value` is no longer `old`.
template <class T>
void wait_for_change(std::atomic<T>& value, T old) {
  for (int i = 0; i < spins; ++i) {
    if (value.load(std::memory_order_acquire) != old) return;
    pause();
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

Pool::Pool(int threads) {
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
}

Pool::~Pool() {
  stopping_ = true;
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  for (std::thread& w : workers_) w.join();
}

void Pool::run(std::int64_t blocks, void (*body)(void*, std::int64_t), void* context) {
  // Chunks small enough that a thread which the machine holds up does not hold up the others.
  job_ = {body, context, blocks, std::max<std::int64_t>(1, blocks / (std::int64_t{8} * threads()))};
  next_.store(0, std::memory_order_relaxed);
  busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  take_blocks();
  for (int left = busy_.load(std::memory_order_acquire); left > 0; left = busy_.load(std::memory_order_acquire))
    wait_for_change(busy_, left);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Pool::take_blocks() {
  try {
    for (;;) {
      const std::int64_t first = next_.fetch_add(job_.chunk, std::memory_order_relaxed);
      if (first >= job_.blocks) return;
      const std::int64_t last = std::min(first + job_.chunk, job_.blocks);
      for (std::int64_t b = first; b < last; ++b) job_.body(job_.context, b);
    }
  } catch (...) {
    next_.store(job_.blocks, std::memory_order_relaxed);
    const std::lock_guard lock(failure_mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

void Pool::work() {
  std::uint32_t seen = 0;
  for (;;) {
    wait_for_change(generation_, seen);
    seen = generation_.load(std::memory_order_acquire);
    if (stopping_) return;
    take_blocks();
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_all();
  }
}

}  // namespace tessera::parallel
