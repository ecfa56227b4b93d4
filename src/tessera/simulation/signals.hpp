#pragma once

namespace tessera {

/// Turns SIGINT, SIGTERM and SIGUSR1 into a wish to stop while it lives.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals();

  /// The number of the signal that came, or zero.
  static int received();

 private:
  void (*previous_[3])(int);
};

}  // namespace tessera
