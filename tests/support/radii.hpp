#pragma once

#include <random>
#include <vector>

namespace tessera::test {

/// Weights of radii up to `largest` [m], so different that faces lie far from the middles of branches.
inline std::vector<double> weights_up_to(double largest, std::size_t points, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> weights;
  for (std::size_t i = 0; i < points; ++i) {
    const double r = largest * static_cast<double>(random()) / 0x1p32;
    weights.push_back(r * r);
  }
  return weights;
}

}  // namespace tessera::test
