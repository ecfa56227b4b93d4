#include "tessera/bench/accuracy.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tessera/bench/cantilever.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

AccuracyRow measure(Formulation formulation, Integration integration, int per_metre) {
  const CantileverPath path = run_cantilever(formulation, per_metre, integration);
  return {per_metre, path.particles, path.steps, path.seconds, path_error(path, formulation, per_metre)};
}

bool has_between(const AccuracyRow& coarse, const AccuracyRow& fine, double error) {
  return coarse.error > error && fine.error <= error;
}

/// The line through two rows at `error`.
std::optional<TimeToError> on_line(const AccuracyRow& coarse, const AccuracyRow& fine, double error) {
  if (!(fine.error < coarse.error)) return std::nullopt;
  const double part = std::log(coarse.error / error) / std::log(coarse.error / fine.error);
  return TimeToError{coarse.seconds * std::pow(fine.seconds / coarse.seconds, part), !has_between(coarse, fine, error)};
}

}  // namespace

std::optional<TimeToError> time_to_error(std::span<const AccuracyRow> rows, double error) {
  if (rows.size() < 2) return std::nullopt;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (has_between(rows[i - 1], rows[i], error)) return on_line(rows[i - 1], rows[i], error);
  if (rows[0].error <= error) return TimeToError{rows[0].seconds, false, true};
  return on_line(rows[rows.size() - 2], rows.back(), error);
}

AccuracyForTime measure_accuracy(Formulation formulation, Integration integration) {
  AccuracyForTime result;
  result.formulation = formulation == Formulation::delaunay ? "delaunay" : "voronoi";
  result.integration = name_of(integration);
  result.threads = parallel::threads();
  for (const int per_metre : {4, 8, 16}) {
    if (per_metre == 16 && result.rows.back().error <= wanted_error) break;
    fmt::print(stderr, "bench: cantilever, {}, {}, {} per metre\n", result.formulation, result.integration, per_metre);
    result.rows.push_back(measure(formulation, integration, per_metre));
  }
  result.to_wanted_error = time_to_error(result.rows, wanted_error);
  return result;
}

}  // namespace tessera
