#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tessera/bench/accuracy.hpp"

namespace tessera {

/// Speed: set-up, sweeps and steps of a cube. Accuracy: the time that an error of the cantilever takes.
enum class BenchParts { everything, speed, accuracy };

/// What to measure; unset: all sizes, all numbers of threads (accuracy: as many as there are), nodal integration of
/// voronoi for the speed, all integrations of both formulations for the accuracy.
struct BenchOptions {
  std::optional<Index> particles;
  std::optional<int> threads;
  std::optional<Formulation> formulation;
  std::optional<Integration> integration;
  BenchParts parts = BenchParts::everything;
};

/// One size with one number of threads: particles of a jittered (0.25) lattice in a box.
struct BenchRow {
  std::int64_t particles = 0;
  int threads = 1;
  std::string formulation;
  std::string integration;
  double particle_steps_per_second = 0.0;  // median of several batches of steps
  double bytes_per_particle_step = 0.0;    // counted from the data layout, gathers of neighbours from cache
  double bytes_per_particle = 0.0;         // resident data of the mechanics
  double setup_seconds = 0.0;
  std::optional<double> setup_peak_bytes;  // resident memory at its peak during set-up, for a particle; Linux only
  std::map<std::string, double> stages;    // seconds: set-up stages once, sweeps a step (median)
};

struct BenchReport {
  std::map<int, double> triad_bytes_per_second;  // by number of threads
  std::vector<BenchRow> rows;
  std::vector<AccuracyForTime> accuracy;
};

/// The formulations and integrations whose accuracy is measured.
std::vector<MethodSpec> methods_of_accuracy(const BenchOptions& options);

/// Measures on this machine; says on stderr what runs. Throws UsageError when a size does not fit into memory.
BenchReport run_bench(const BenchOptions& options);

std::string to_json(const BenchReport& report);
std::string to_table(const BenchReport& report);

}  // namespace tessera
