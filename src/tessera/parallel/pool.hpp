#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tessera::parallel {

/// Threads that sleep until there are blocks to work on. They wait passively after a short spin, so that a busy machine
/// does not lose time to them.
class Pool {
 public:
  /// `threads` includes the calling one.
  explicit Pool(int threads);
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool();

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(context, block) for every block in [0, blocks), on any thread, and returns when all are done. An
  /// exception that a call throws ends the others early and reaches the caller.
  void run(std::int64_t blocks, void (*body)(void*, std::int64_t), void* context);

 private:
  void work();
  void take_blocks();

  struct Job {
    void (*body)(void*, std::int64_t) = nullptr;
    void* context = nullptr;
    std::int64_t blocks = 0, chunk = 1;
  };

  std::vector<std::thread> workers_;
  Job job_;
  alignas(64) std::atomic<std::int64_t> next_{0};
  alignas(64) std::atomic<int> busy_{0};
  alignas(64) std::atomic<std::uint32_t> generation_{0};
  std::atomic<bool> stopping_{false};
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

}  // namespace tessera::parallel
