#include <benchmark/benchmark.h>

#include "tessera/parallel/parallel.hpp"

// One thread: what is compared are pieces of work, not how they are shared.
int main(int count, char** arguments) {
  tessera::parallel::set_threads(1);
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  const std::size_t run = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return run > 0 ? 0 : 1;
}
