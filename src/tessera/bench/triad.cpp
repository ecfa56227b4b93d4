#include "tessera/bench/triad.hpp"

#include <algorithm>
#include <chrono>

#include "tessera/base/field.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

double triad_bandwidth() {
  constexpr std::int64_t n = std::int64_t{1} << 25;  // 256 MiB an array
  constexpr double bytes_per_element = 32.0;
  Field<double> a(n), b(n), c(n);
  parallel::for_each(n, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    a[k] = 0.0, b[k] = 1.0, c[k] = 2.0;
  });
  double best = 1e300;
  for (int sweep = 0; sweep < 7; ++sweep) {
    const auto start = std::chrono::steady_clock::now();
    double *x = a.data(), *y = b.data(), *z = c.data();
    parallel::for_ranges(0, n, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) x[i] = y[i] + 3.0 * z[i];
    });
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    std::swap(a, b);
  }
  return bytes_per_element * static_cast<double>(n) / best;
}

}  // namespace tessera
