#include "tessera/output/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>

namespace tessera {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using Stream = std::unique_ptr<std::FILE, Close>;

std::string content(std::FILE* file) {
  std::rewind(file);
  std::string text(100000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  return text;
}

TEST(Progress, LineSaysWhereTheRunStands) {
  const ProgressState state{0.21, 0.5, 1234, 1000, 500.0, 75.0, -1.3e-5};
  EXPECT_EQ(progress_line(state),
            " 42%  t = 0.21 of 0.5 s  500 steps/s  5e+05 particle-steps/s  ETA 1:15  energy error -1.3e-05");
}

TEST(Progress, LineLeavesOutWhatIsNotKnown) {
  EXPECT_EQ(progress_line({0.0, 0.5, 0, 1000, 0.0, -1.0, 0.0}), "  0%  t = 0 of 0.5 s  energy error 0.0e+00");
  EXPECT_EQ(progress_line({0.0, 0.0, 0, 1000, 0.0, -1.0, 0.0}).substr(0, 4), "100%");
}

TEST(Progress, Durations) {
  EXPECT_EQ(duration_text(7.4), "0:07");
  EXPECT_EQ(duration_text(754.0), "12:34");
  EXPECT_EQ(duration_text(3723.0), "1:02:03");
  EXPECT_EQ(duration_text(2 * 86400 + 3 * 3600 + 245), "2d 03:04:05");
}

TEST(Progress, PipesGetALineAtEveryTenth) {
  const Stream file(std::tmpfile());
  Progress progress(file.get(), ProgressStyle::lines, 1.0, 10);
  for (int i = 1; i <= 1000; ++i) progress.update(0.001 * i, i, 0.0);
  progress.finish(1.0, 1000, 0.0);
  const std::string text = content(file.get());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.substr(0, 4), " 10%");
  EXPECT_NE(text.find("\n100%"), std::string::npos);
}

TEST(Progress, AResumedRunBeginsAtItsOwnTenth) {
  const Stream file(std::tmpfile());
  Progress progress(file.get(), ProgressStyle::lines, 1.0, 10, 0.55, 550);
  progress.update(0.56, 560, 0.0);
  EXPECT_EQ(content(file.get()), "");
  progress.update(0.95, 950, 0.0);
  const std::string text = content(file.get());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.substr(0, 4), " 95%");
}

TEST(Progress, TerminalsGetOneLineThatRenewsItself) {
  const Stream file(std::tmpfile());
  Progress progress(file.get(), ProgressStyle::terminal, 1.0, 10);
  for (int i = 1; i <= 1000; ++i) progress.update(0.0005 * i, i, 0.0);
  EXPECT_EQ(content(file.get()), "");  // not every step, only several times a second
  std::this_thread::sleep_for(std::chrono::milliseconds(220));
  progress.update(0.5, 1000, 0.0);
  progress.finish(1.0, 2000, 0.0);
  const std::string text = content(file.get());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.back(), '\n');
}

TEST(Progress, SilentSaysNothing) {
  const Stream file(std::tmpfile());
  Progress progress(file.get(), ProgressStyle::silent, 1.0, 10);
  progress.update(0.5, 1, 0.0);
  progress.finish(1.0, 2, 0.0);
  EXPECT_EQ(content(file.get()), "");
}

TEST(Progress, AFileIsNoTerminal) {
  const Stream file(std::tmpfile());
  EXPECT_EQ(progress_style(file.get()), ProgressStyle::lines);
}

}  // namespace
}  // namespace tessera
