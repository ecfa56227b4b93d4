#pragma once

#include <chrono>

namespace tessera {

/// Adds the wall-clock time of its life to an account [s].
class Stopwatch {
 public:
  explicit Stopwatch(double& account) : account_(account) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { account_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& account_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tessera
