#include "tessera/parallel/parallel.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include "tessera/base/error.hpp"
#include "tessera/parallel/pool.hpp"

namespace tessera::parallel {

namespace {

// Fewer blocks than this cost less than waking other threads.
constexpr std::int64_t fewest_blocks = 8;
constexpr long most_threads = 4096;

/// OMP_NUM_THREADS, which batch systems set (of a list the first), or all processors.
int default_threads() {
  if (const char* text = std::getenv("OMP_NUM_THREADS"); text != nullptr && *text != '\0') {
    char* end = nullptr;
    const long n = std::strtol(text, &end, 10);
    if (n < 1 || n > most_threads || (*end != '\0' && *end != ','))
      throw UsageError("the environment variable OMP_NUM_THREADS is \"" + std::string(text) +
                       "\"; expected a number from 1 to " + std::to_string(most_threads));
    return static_cast<int>(n);
  }
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

struct Setting {
  int threads = 0;  // not chosen yet
  std::unique_ptr<Pool> pool;
};

Setting& setting() {
  static Setting s;
  return s;
}

// Set while blocks are being worked on: a nested call runs where it is.
thread_local bool inside = false;

struct Nested {
  Nested() { inside = true; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  ~Nested() { inside = false; }
};

}  // namespace

int threads() {
  if (setting().threads == 0) setting().threads = default_threads();
  return setting().threads;
}

void set_threads(int n) {
  if (n <= 0) n = threads();
  if (n == setting().threads) return;
  setting().pool.reset();
  setting().threads = n;
}

namespace detail {

void keep_to_this_thread() { inside = true; }

void run_blocks(std::int64_t blocks, void (*body)(void*, std::int64_t), void* context) {
  if (blocks < fewest_blocks || threads() == 1 || inside) {
    for (std::int64_t b = 0; b < blocks; ++b) body(context, b);
    return;
  }
  Setting& s = setting();
  if (!s.pool) s.pool = std::make_unique<Pool>(s.threads);
  struct Call {
    void (*body)(void*, std::int64_t);
    void* context;
  } call{body, context};
  s.pool->run(
      blocks,
      [](void* p, std::int64_t block) {
        const Nested nested;
        const Call& c = *static_cast<Call*>(p);
        c.body(c.context, block);
      },
      &call);
}

}  // namespace detail

}  // namespace tessera::parallel
