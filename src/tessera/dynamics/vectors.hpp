#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

/// One vector a particle, as a vector of all degrees of freedom.
using Vectors = Field<Double4>;

inline double inner(const Vectors& a, const Vectors& b) {
  return parallel::sum<double>(static_cast<std::int64_t>(a.size()), [&](std::int64_t i) {
    return dot3(a[static_cast<std::size_t>(i)], b[static_cast<std::size_t>(i)]);
  });
}

inline double length(const Vectors& a) { return std::sqrt(inner(a, a)); }

inline void scale(Vectors& a, double s) {
  parallel::for_each(static_cast<std::int64_t>(a.size()), [&](std::int64_t i) { a[static_cast<std::size_t>(i)] *= s; });
}

/// splitmix64
inline std::uint64_t scrambled(std::uint64_t i) {
  i += 0x9E3779B97F4A7C15ULL;
  i = (i ^ (i >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  i = (i ^ (i >> 27U)) * 0x94D049BB133111EBULL;
  return i ^ (i >> 31U);
}

/// A reproducible vector without structure: every mode takes part.
inline Vectors rough_vector(std::size_t n, std::uint64_t seed) {
  Vectors v(n);
  parallel::for_each(static_cast<std::int64_t>(n), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < 3; ++k)
      v[a][k] = static_cast<double>(scrambled(scrambled(seed) + 3 * a + k) >> 11U) * 0x1p-53 - 0.5;
  });
  return v;
}

/// For parallel sums that take the largest value instead.
struct Largest {
  double value = 0.0;
  Largest& operator+=(const Largest& o) {
    value = std::max(value, o.value);
    return *this;
  }
};

/// The largest of value(i) >= 0 over [0, n); a value that is no number does not count.
template <class Value>
double largest_of(std::int64_t n, Value&& value) {
  return parallel::sum<Largest>(n, [&value](std::int64_t i) { return Largest{value(i)}; }).value;
}

}  // namespace tessera
