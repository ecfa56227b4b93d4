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
