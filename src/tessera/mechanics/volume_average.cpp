#include "tessera/mechanics/volume_average.hpp"

#include <cmath>

#include "tessera/mechanics/tile_nodes.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

// Sums are then right to a per cent or so, even where volumes differ; what is missing stays with the particle itself.
constexpr int scalings = 20;

/// The means of consecutive particles. Four bonds at a time, since each sum would wait for the one before.
TESSERA_KERNEL void mean_rows(const VolumeAverage& rows, std::size_t begin, std::size_t end,
                              const double* __restrict value, double* __restrict mean) {
  const Index* neighbour = rows.neighbour.data();
  const double* weight = rows.weight.data();
  for (std::size_t a = begin; a < end; ++a) {
    const double own = value[a];
    Offset i = rows.offset[a];
    const Offset last = rows.offset[a + 1];
    Double4 sums{};
    for (; i + 4 <= last; i += 4) {
      const Index* b = neighbour + i;
      Double4 w;
      __builtin_memcpy(&w, weight + i, sizeof w);
      sums += w * (Double4{value[b[0]], value[b[1]], value[b[2]], value[b[3]]} - own);
    }
    double rest = 0.0;
    for (; i < last; ++i) rest += weight[i] * (value[neighbour[i]] - own);
    mean[a] = own + (sum(sums) + rest);
  }
}

}  // namespace

void VolumeAverage::mean_twice(const std::vector<double>& values, std::vector<double>& once,
                               std::vector<double>& mean_of_means) const {
  const auto pass = [&](const std::vector<double>& from, std::vector<double>& to) {
    parallel::for_ranges(0, static_cast<std::int64_t>(from.size()), [&](std::int64_t begin, std::int64_t end) {
      mean_rows(*this, static_cast<std::size_t>(begin), static_cast<std::size_t>(end), from.data(), to.data());
    });
  };
  pass(values, once);
  pass(once, mean_of_means);
}

VolumeAverage volume_average(const Discretization& d) {
  VolumeAverage average;
  average.offset = d.bonds.offset;
  average.neighbour = d.bonds.neighbour;
  average.weight.resize(d.bonds.neighbour.size());
  const RawField<double>& K = d.bonds.area_over_length;
  const auto for_each_row = [&](auto&& body) {
    parallel::for_each(d.particles(), [&](std::int64_t a) {
      const auto row = static_cast<Index>(a);
      body(static_cast<std::size_t>(a), static_cast<std::size_t>(d.bonds.begin(row)),
           static_cast<std::size_t>(d.bonds.end(row)));
    });
  };
  // c_a c_b K_ab with the sum V_a / 2 over b: repeated scaling, the geometric mean of old and new factors.
  std::vector<double> c(d.X.size(), 1.0), next(d.X.size());
  const auto reach = [&](std::size_t a, std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += K[i] * c[static_cast<std::size_t>(average.neighbour[i])];
    return c[a] * sum;
  };
  for (int i = 0; i < scalings; ++i) {
    for_each_row([&](std::size_t a, std::size_t begin, std::size_t end) {
      const double sum = reach(a, begin, end);
      next[a] = sum > 0.0 ? c[a] * std::sqrt(0.5 * d.volume[a] / sum) : 0.0;
    });
    c.swap(next);
  }
  for_each_row([&](std::size_t a, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      average.weight[i] = K[i] * c[a] * c[static_cast<std::size_t>(average.neighbour[i])] / d.volume[a];
  });
  return average;
}

}  // namespace tessera
