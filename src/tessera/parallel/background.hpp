#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace tessera::parallel {

/// Does one job at a time beside the calling thread. Loops inside a job run on its thread alone. A job that fails
/// reports to the next call of start(), wait() or check(), which throws what the job threw.
class Background {
 public:
  Background() = default;
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  /// Waits for the job; nobody is left to hear of its failure.
  ~Background();

  /// Begins `job`. Waits for the one before, so that what jobs hold never piles up.
  void start(std::function<void()> job);
  /// Returns when there is nothing to do.
  void wait();
  /// Throws if a job has failed, without waiting.
  void check();
  /// As wait(), and forgets a failure: for who is busy with another one.
  void settle() noexcept;

 private:
  void work();
  void rethrow(std::unique_lock<std::mutex> lock);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> job_;  // waiting or being done
  std::exception_ptr failure_;
  bool stopping_ = false;
  std::thread worker_;  // begun with the first job
};

}  // namespace tessera::parallel
