#pragma once

#include <cstdint>

namespace tessera {

namespace detail {
/// The finaliser of Steele, Lea and Flood's SplitMix64: spreads every bit of the argument over the result.
inline std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}
}  // namespace detail

/// A number from 0 to below 1 that depends on nothing but the seed and the counter: the same on every machine, in
/// whatever order numbers are asked for.
inline double random_number(std::uint64_t seed, std::uint64_t counter) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t bits = detail::mix(detail::mix(seed + golden) + golden * (counter + 1));
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

}  // namespace tessera
