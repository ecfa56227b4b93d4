#pragma once

#include "tessera/laws/material.hpp"

namespace tessera {

/// The material of all bodies of the benchmark: that of the cantilever of [D 8.4].
inline Material bench_rubber() {
  Material m;
  m.name = "rubber";
  m.young = 17e6;
  m.poisson = 0.3;
  m.density = 1100.0;
  m.law = NeoHookean::from_young_poisson(m.young, m.poisson);
  return m;
}

}  // namespace tessera
