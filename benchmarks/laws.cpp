#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "tessera/base/field.hpp"
#include "tessera/laws/neo_hookean_lanes.hpp"

// Compiled for several instruction sets, as the sweeps are.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__OPTIMIZE__)
#define BENCHMARK_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), flatten))
#else
#define BENCHMARK_KERNEL
#endif

namespace tessera::benchmarks {

constexpr std::size_t deformations = 1024;  // in the cache nearest to the processor or the next
constexpr std::size_t lanes = 4;
constexpr NeoHookean rubber = NeoHookean::from_young_poisson(17e6, 0.3);

/// Deformations of up to about 30%.
std::vector<Mat3> some_deformations() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-0.1, 0.1);
  std::vector<Mat3> F(deformations, identity());
  for (Mat3& f : F)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) f(i, j) += part(random);
  return F;
}

Field<Lanes9> in_lanes(const std::vector<Mat3>& F) {
  Field<Lanes9> all(F.size() / lanes);
  for (std::size_t i = 0; i < F.size(); ++i) {
    Lanes9& l = all[i / lanes];
    Double4* components[] = {&l.xx, &l.xy, &l.xz, &l.yx, &l.yy, &l.yz, &l.zx, &l.zy, &l.zz};
    for (std::size_t c = 0; c < 9; ++c)
      (*components[c])[i % lanes] = F[i](static_cast<int>(c) / 3, static_cast<int>(c) % 3);
  }
  return all;
}

BENCHMARK_KERNEL void respond(const Mat3* F, ElasticResponse* out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = rubber.response(F[i]);
}

BENCHMARK_KERNEL void respond_in_lanes(const Lanes9* F, LanesResponse* out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = response(rubber, F[i]);
}

BENCHMARK_KERNEL void logarithms(const double* x, double* out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = std::log(x[i]);
}

BENCHMARK_KERNEL void logarithms_in_lanes(const Double4* x, Double4* out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = log(x[i]);
}

void finish(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(deformations));
}

void neo_hookean_scalar(benchmark::State& state) {
  const std::vector<Mat3> F = some_deformations();
  std::vector<ElasticResponse> out(F.size());
  for (auto _ : state) {
    respond(F.data(), out.data(), F.size());
    benchmark::ClobberMemory();
  }
  finish(state);
}
BENCHMARK(neo_hookean_scalar);

void neo_hookean_four_lanes(benchmark::State& state) {
  const Field<Lanes9> F = in_lanes(some_deformations());
  Field<LanesResponse> out(F.size());
  for (auto _ : state) {
    respond_in_lanes(F.data(), out.data(), F.size());
    benchmark::ClobberMemory();
  }
  finish(state);
}
BENCHMARK(neo_hookean_four_lanes);

/// Determinants of the deformations, a Field so that they can be read one by one or four at once.
Field<Double4> determinants() {
  const std::vector<Mat3> F = some_deformations();
  Field<Double4> J(F.size() / lanes);
  for (std::size_t i = 0; i < F.size(); ++i) J[i / lanes][i % lanes] = determinant(F[i]);
  return J;
}

void log_standard(benchmark::State& state) {
  const Field<Double4> J = determinants();
  std::vector<double> x, out(deformations);
  for (const Double4& four : J)
    for (std::size_t i = 0; i < lanes; ++i) x.push_back(four[i]);
  for (auto _ : state) {
    logarithms(x.data(), out.data(), x.size());
    benchmark::ClobberMemory();
  }
  finish(state);
}
BENCHMARK(log_standard);

void log_four_lanes(benchmark::State& state) {
  const Field<Double4> x = determinants();
  Field<Double4> out(x.size());
  for (auto _ : state) {
    logarithms_in_lanes(x.data(), out.data(), x.size());
    benchmark::ClobberMemory();
  }
  finish(state);
}
BENCHMARK(log_four_lanes);

}  // namespace tessera::benchmarks
