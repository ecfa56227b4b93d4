#include "tessera/output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

constexpr auto renewal = std::chrono::milliseconds(200);

}  // namespace

ProgressStyle progress_style(std::FILE* stream) {
  return ::isatty(::fileno(stream)) ? ProgressStyle::terminal : ProgressStyle::lines;
}

std::string duration_text(double seconds) {
  const auto total = static_cast<std::int64_t>(std::llround(std::clamp(seconds, 0.0, 1e12)));
  const std::int64_t days = total / 86400, hours = total / 3600 % 24, minutes = total / 60 % 60, rest = total % 60;
  if (days > 0) return fmt::format("{}d {:02}:{:02}:{:02}", days, hours, minutes, rest);
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, rest);
  return fmt::format("{}:{:02}", minutes, rest);
}

std::string progress_line(const ProgressState& s) {
  const double percent = s.end > 0.0 ? 100.0 * std::min(s.time / s.end, 1.0) : 100.0;
  std::string line = fmt::format("{:3.0f}%  t = {:.4g} of {:.4g} s", std::floor(percent), s.time, s.end);
  if (s.steps_per_second > 0.0)
    line += fmt::format("  {:.4g} steps/s  {:.3g} particle-steps/s", s.steps_per_second,
                        s.steps_per_second * static_cast<double>(s.particles));
  if (s.remaining >= 0.0) line += "  ETA " + duration_text(s.remaining);
  return line + fmt::format("  energy error {:.1e}", s.energy_error);
}

Progress::Progress(std::FILE* stream, ProgressStyle style, double end, std::int64_t particles, double time,
                   std::int64_t step)
    : stream_(stream),
      style_(style),
      end_(end),
      particles_(particles),
      first_time_(time),
      first_step_(step),
      shown_tenth_(tenth(time)) {}

ProgressState Progress::state(double time, std::int64_t step, double energy_error) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double advanced = time - first_time_;
  ProgressState state{time, end_, step, particles_, 0.0, -1.0, energy_error};
  if (elapsed > 0.0) state.steps_per_second = static_cast<double>(step - first_step_) / elapsed;
  if (advanced > 0.0) state.remaining = elapsed * std::max(end_ - time, 0.0) / advanced;
  return state;
}

int Progress::tenth(double time) const {
  // The last step may end a rounding error before the end.
  return end_ > 0.0 ? static_cast<int>(10.0 * std::clamp(time / end_, 0.0, 1.0) + 1e-9) : 10;
}

void Progress::renew(const std::string& line) {
  fmt::print(stream_, "\r{:<{}}", line, shown_length_);
  std::fflush(stream_);
  shown_length_ = line.size();
}

void Progress::update(double time, std::int64_t step, double energy_error) {
  if (style_ == ProgressStyle::terminal && Clock::now() - shown_at_ >= renewal) {
    shown_at_ = Clock::now();
    renew(progress_line(state(time, step, energy_error)));
  }
  if (style_ == ProgressStyle::lines && tenth(time) > shown_tenth_) {
    shown_tenth_ = tenth(time);
    fmt::print(stream_, "{}\n", progress_line(state(time, step, energy_error)));
    std::fflush(stream_);
  }
}

void Progress::finish(double time, std::int64_t step, double energy_error) {
  update(time, step, energy_error);
  if (style_ == ProgressStyle::terminal) renew(progress_line(state(time, step, energy_error)));
  interrupt();
}

void Progress::interrupt() {
  if (style_ != ProgressStyle::terminal || shown_length_ == 0) return;
  fmt::print(stream_, "\n");
  std::fflush(stream_);
  shown_length_ = 0;
}

}  // namespace tessera
