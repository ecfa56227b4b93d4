#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tessera/parallel/parallel.hpp"
#include "tessera/parallel/sort.hpp"

namespace tessera::parallel {
namespace {

/// Puts the number of threads back at the end of a test.
class Parallel : public testing::Test {
 protected:
  ~Parallel() override { set_threads(before_); }

 private:
  int before_ = threads();
};

constexpr std::int64_t many = 50 * block_size + 17;

/// Terms of very different size, so that another order of summation shows in the last bits.
double term(std::int64_t i) { return std::sin(static_cast<double>(i)) * std::pow(10.0, static_cast<double>(i % 17)); }

TEST_F(Parallel, SumsHaveTheSameBitsForAnyNumberOfThreads) {
  set_threads(1);
  const double one = sum<double>(many, term);
  for (int n : {2, 3, 7})
    for (int repeat = 0; repeat < 20; ++repeat) {
      set_threads(n);
      EXPECT_EQ(threads(), n);
      EXPECT_EQ(sum<double>(many, term), one);
    }
}

TEST_F(Parallel, SumsAreRight) {
  for (std::int64_t n : {std::int64_t{0}, std::int64_t{1}, block_size - 1, block_size, block_size + 1, many})
    EXPECT_EQ(sum<std::int64_t>(n, [](std::int64_t i) { return i; }), n * (n - 1) / 2) << n;
}

TEST_F(Parallel, EveryItemIsVisitedOnce) {
  for (int n : {1, 2, 5}) {
    set_threads(n);
    std::vector<int> visits(static_cast<std::size_t>(many), 0);
    for_each(many, [&](std::int64_t i) { ++visits[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), many);
  }
}

TEST_F(Parallel, RangesCoverWhatTheyAreGiven) {
  set_threads(3);
  std::vector<int> visits(static_cast<std::size_t>(many), 0);
  for_ranges(100, many - 5, [&](std::int64_t begin, std::int64_t end) {
    EXPECT_LE(end - begin, block_size);
    for (std::int64_t i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
  });
  for (std::int64_t i = 0; i < many; ++i)
    ASSERT_EQ(visits[static_cast<std::size_t>(i)], i >= 100 && i < many - 5 ? 1 : 0) << i;
  bool called = false;
  for_ranges(5, 5, [&](std::int64_t, std::int64_t) { called = true; });
  for_ranges(5, 3, [&](std::int64_t, std::int64_t) { called = true; });
  EXPECT_FALSE(called);
}

/// Sums over a range that does not start at a block's boundary.
TEST_F(Parallel, SumsOverPartsOfARangeHaveTheSameBits) {
  const auto part = [](std::int64_t begin, std::int64_t end) {
    double s = 0.0;
    for (std::int64_t i = begin; i < end; ++i) s += term(i);
    return s;
  };
  set_threads(1);
  const double one = sum_ranges<double>(333, many, part);
  set_threads(2);
  EXPECT_EQ(sum_ranges<double>(333, many, part), one);
}

TEST_F(Parallel, LoopsMayContainLoops) {
  set_threads(2);
  std::vector<double> values(static_cast<std::size_t>(20 * block_size));
  for_each(static_cast<std::int64_t>(values.size()), [&](std::int64_t i) {
    if (i % block_size == 0) values[static_cast<std::size_t>(i)] = sum<double>(12 * block_size, term);
  });
  const double expected = sum<double>(12 * block_size, term);
  for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(block_size)) EXPECT_EQ(values[i], expected);
}

/// An exception in the body reaches the caller, whoever met it, and the next loop is whole again.
TEST_F(Parallel, ExceptionsReachTheCaller) {
  for (int n : {1, 2, 4}) {
    set_threads(n);
    for (std::int64_t bad : {std::int64_t{0}, many / 2, many - 1}) {
      const auto body = [&](std::int64_t i) {
        if (i == bad) throw std::runtime_error("item " + std::to_string(i));
      };
      try {
        for_each(many, body);
        ADD_FAILURE() << "no exception";
      } catch (const std::runtime_error& e) {
        EXPECT_EQ(e.what(), "item " + std::to_string(bad));
      }
      EXPECT_EQ(sum<std::int64_t>(many, [](std::int64_t) { return std::int64_t{1}; }), many);
    }
  }
}

TEST_F(Parallel, ManyExceptionsAtOnceAreOne) {
  set_threads(4);
  for (int repeat = 0; repeat < 50; ++repeat)
    EXPECT_THROW(for_each(many, [](std::int64_t) { throw std::runtime_error("all"); }), std::runtime_error);
  EXPECT_EQ(sum<std::int64_t>(many, [](std::int64_t) { return std::int64_t{1}; }), many);
}

/// More than one thread takes part after an exception as well: the body waits until a second thread has come.
TEST_F(Parallel, ThreadsAreStillSharedAfterAnException) {
  set_threads(2);
  EXPECT_THROW(for_each(many, [](std::int64_t) { throw std::runtime_error("all"); }), std::runtime_error);
  std::atomic<int> together{0};
  std::atomic<bool> met{false};
  for_ranges(0, many, [&](std::int64_t, std::int64_t) {
    if (++together > 1) met = true;
    for (int spin = 0; spin < 2000000 && !met; ++spin) {
    }
    --together;
  });
  EXPECT_TRUE(met);
}

TEST_F(Parallel, SortsWhateverTheLength) {
  for (const int n : {1, 2, 3}) {
    set_threads(n);
    for (const std::size_t size : {0U, 1U, 1000U, 16384U, 16385U, 300001U}) {
      std::vector<std::uint64_t> items(size);
      for (std::size_t i = 0; i < size; ++i) items[i] = (i + 1) * 0x9e3779b97f4a7c15ULL;
      std::vector<std::uint64_t> expected = items;
      std::sort(expected.begin(), expected.end());
      sort(items);
      EXPECT_EQ(items, expected) << size;
    }
  }
}

TEST_F(Parallel, NonPositiveThreadsKeepTheSetting) {
  set_threads(3);
  set_threads(0);
  set_threads(-1);
  EXPECT_EQ(threads(), 3);
}

}  // namespace
}  // namespace tessera::parallel
