#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "support/small_bodies.hpp"

namespace tessera::test {

/// The total forces at `state` are minus the derivative of potential(State) by the positions of all particles, by
/// central differences, to 2e-7 of the largest force.
template <class Potential>
void expect_minus_gradient(const State& state, const Forces& forces, const Potential& potential) {
  double scale = 0.0;
  for (const Double4& f : forces.total()) scale = std::max(scale, norm(to_vec3(f)));
  const double h = 1e-5;
  for (std::size_t a = 0; a < state.v.size(); ++a)
    for (int i = 0; i < 3; ++i) {
      State plus = state, minus = state;
      plus.x[a][i] += h;
      minus.x[a][i] -= h;
      EXPECT_NEAR(forces.total()[a][i], -(potential(plus) - potential(minus)) / (2.0 * h), 2e-7 * scale) << a;
    }
}

}  // namespace tessera::test
