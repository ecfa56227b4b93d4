#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tessera/simulation/case.hpp"

namespace tessera {

/// The error that a user may ask for: one per cent of the path of the cantilever's tip.
inline constexpr double wanted_error = 0.01;

/// One run of the swinging cantilever [D 8.4] with all threads.
struct AccuracyRow {
  int per_metre = 0;  // particles
  std::int64_t particles = 0;
  std::int64_t steps = 0;
  double seconds = 0.0;  // wall-clock time of the steps
  double error = 0.0;    // path_error() of bench/cantilever.hpp
};

/// How long a run takes that just has an error.
struct TimeToError {
  double seconds = 0.0;
  bool extrapolated = false;  // all rows err more
  bool upper_bound = false;   // all rows err less, so the coarsest takes longer than needed
};

/// The time for an error, on a straight line in the logarithms of error and time: between two successive rows that have
/// it between them, or else, with the order that they show, beyond the last two (all errors larger); nothing where
/// those errors do not fall. If all errors are smaller, the time of the first row: a coarser body might do as well, but
/// what is too coarse to bend shows no order. Rows go from coarse to fine.
std::optional<TimeToError> time_to_error(std::span<const AccuracyRow> rows, double error);

/// What accuracy costs with one formulation and integration.
struct AccuracyForTime {
  std::string formulation, integration;
  int threads = 1;
  std::vector<AccuracyRow> rows;
  std::optional<TimeToError> to_wanted_error;
};

/// Runs the cantilever with 4 and 8 particles per metre, and with 16 if the error is not yet the wanted one. Says on
/// stderr what runs.
AccuracyForTime measure_accuracy(Formulation formulation, Integration integration);

}  // namespace tessera
