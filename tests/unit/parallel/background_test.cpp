#include "tessera/parallel/background.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tessera/parallel/parallel.hpp"

namespace tessera::parallel {
namespace {

void fail() { throw std::runtime_error("the disk is full"); }

TEST(Background, DoesJobsOneAfterTheOther) {
  std::vector<int> done;  // without a lock: jobs never overlap
  {
    Background background;
    for (int i = 0; i < 100; ++i) background.start([&done, i] { done.push_back(i); });
  }
  ASSERT_EQ(done.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

TEST(Background, LetsTheCallerGoOn) {
  std::atomic<bool> may_end = false;
  Background background;
  background.start([&] { may_end.wait(false); });
  background.check();
  may_end = true;  // would never come if start() waited for the job
  may_end.notify_all();
  background.wait();
}

TEST(Background, TellsOfAFailureOnce) {
  Background background;
  background.wait();
  background.start(fail);
  EXPECT_THROW(background.wait(), std::runtime_error);
  background.wait();
  background.check();
  background.start(fail);
  bool begun = false;
  EXPECT_THROW(background.start([&begun] { begun = true; }), std::runtime_error);
  background.wait();
  EXPECT_FALSE(begun);
}

TEST(Background, CheckHearsOfAFailureWithoutWaiting) {
  Background background;
  background.start(fail);
  const auto many_checks = [&] {
    for (int i = 0; i < 10000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(1))) background.check();
  };
  EXPECT_THROW(many_checks(), std::runtime_error);
}

TEST(Background, SettlingForgetsAFailure) {
  Background background;
  background.start(fail);
  background.settle();
  background.check();
  background.wait();
}

TEST(Background, LoopsOfAJobKeepToItsThread) {
  const int before = threads();
  set_threads(2);
  std::atomic<int> elsewhere = 0;
  {
    Background background;
    background.start([&elsewhere] {
      const auto here = std::this_thread::get_id();
      for_each(100 * block_size, [&](std::int64_t) { elsewhere += std::this_thread::get_id() != here; });
    });
    EXPECT_EQ(sum<std::int64_t>(100 * block_size, [](std::int64_t) { return 1; }), 100 * block_size);
  }
  EXPECT_EQ(elsewhere, 0);
  set_threads(before);
}

TEST(Tasks, AreAllDoneOnce) {
  const int before = threads();
  for (int n : {1, 2, 5}) {
    set_threads(n);
    for (std::int64_t size : {0, 1, 7, 8, 100}) {
      std::vector<int> done(static_cast<std::size_t>(size), 0);
      for_tasks(size, [&](std::int64_t i) { ++done[static_cast<std::size_t>(i)]; });
      EXPECT_EQ(done, std::vector<int>(static_cast<std::size_t>(size), 1)) << n << " threads";
    }
  }
  set_threads(before);
}

}  // namespace
}  // namespace tessera::parallel
