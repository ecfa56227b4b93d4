#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace tessera {

/// How progress is shown: one line that renews itself (terminal), a line at every tenth of the way (pipe), or not.
enum class ProgressStyle { terminal, lines, silent };

/// The style that suits `stream`: terminal or lines.
ProgressStyle progress_style(std::FILE* stream);

/// Where a run stands.
struct ProgressState {
  double time = 0.0;      // [s]
  double end = 0.0;       // end time [s]
  std::int64_t step = 0;  // steps done
  std::int64_t particles = 0;
  double steps_per_second = 0.0;  // of wall-clock time; 0: not known yet
  double remaining = 0.0;         // wall-clock seconds to the end; negative: not known yet
  double energy_error = 0.0;      // relative
};

/// " 42%  t = 0.21 of 0.5 s  1234 steps/s  1.2e6 particle-steps/s  ETA 0:12  energy error 1.3e-05".
std::string progress_line(const ProgressState& state);

/// "0:07", "12:34", "1:02:03", or days: "2d 03:04:05".
std::string duration_text(double seconds);

/// Shows how a run goes on. Looking at the clock at every step is cheap; the line is made at most five times a second.
class Progress {
 public:
  /// `time` and `step`: where this process begins (not at zero after a resumption).
  Progress(std::FILE* stream, ProgressStyle style, double end, std::int64_t particles, double time = 0.0,
           std::int64_t step = 0);

  void update(double time, std::int64_t step, double energy_error);
  /// Shows the last state and ends the line.
  void finish(double time, std::int64_t step, double energy_error);
  /// Ends a line that is being renewed, so that a message can follow.
  void interrupt();

 private:
  using Clock = std::chrono::steady_clock;

  ProgressState state(double time, std::int64_t step, double energy_error) const;
  int tenth(double time) const;
  void renew(const std::string& line);

  std::FILE* stream_;
  ProgressStyle style_;
  double end_;
  std::int64_t particles_;
  double first_time_;
  std::int64_t first_step_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_at_ = start_;
  int shown_tenth_;
  std::size_t shown_length_ = 0;
};

}  // namespace tessera
