#include "tessera/parallel/parallel.hpp"

#include <omp.h>

namespace tessera::parallel {

int threads() { return omp_get_max_threads(); }

void set_threads(int n) {
  if (n > 0) omp_set_num_threads(n);
}

namespace detail {

void run_blocks(std::int64_t blocks, void (*body)(void*, std::int64_t), void* context) {
  // Fewer than eight blocks cost less than waking the other threads.
  if (blocks < 8 || threads() == 1 || omp_in_parallel()) {
    for (std::int64_t b = 0; b < blocks; ++b) body(context, b);
    return;
  }
#pragma omp parallel for schedule(static)
  for (std::int64_t b = 0; b < blocks; ++b) body(context, b);
}

}  // namespace detail

}  // namespace tessera::parallel
