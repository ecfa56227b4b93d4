#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "tessera/bench/bench.hpp"

namespace tessera {

namespace {

nlohmann::ordered_json accuracy_json(const AccuracyForTime& a) {
  nlohmann::ordered_json j = {{"formulation", a.formulation}, {"integration", a.integration}, {"threads", a.threads}};
  j["rows"] = nlohmann::ordered_json::array();
  for (const AccuracyRow& r : a.rows)
    j["rows"].push_back({{"per_metre", r.per_metre},
                         {"particles", r.particles},
                         {"steps", r.steps},
                         {"seconds", r.seconds},
                         {"error", r.error}});
  j["wanted_error"] = wanted_error;
  j["seconds_to_wanted_error"] = nullptr;
  if (!a.to_wanted_error) return j;
  j["seconds_to_wanted_error"] = a.to_wanted_error->seconds;
  j["extrapolated"] = a.to_wanted_error->extrapolated;
  j["upper_bound"] = a.to_wanted_error->upper_bound;
  return j;
}

// In the order in which they come; a method has some of them.
constexpr std::array stages_of_setup = {"points", "cells", "bonds", "system"};
constexpr std::array stages_of_step = {"strain", "contact", "stress", "force", "rims", "kick"};

template <std::size_t n>
std::vector<std::string> present(const std::array<const char*, n>& names, const BenchReport& report) {
  std::vector<std::string> list;
  for (const char* name : names)
    for (const BenchRow& r : report.rows)
      if (r.stages.contains(name) && (list.empty() || list.back() != name)) list.emplace_back(name);
  return list;
}

double seconds_of(const BenchRow& r, const std::string& stage) {
  const auto found = r.stages.find(stage);
  return found == r.stages.end() ? 0.0 : found->second;
}

/// A column as wide as its heading needs.
std::size_t width_of(const std::string& heading) { return std::max<std::size_t>(8, heading.size() + 2); }

std::string table_of_steps(const BenchReport& report) {
  const std::vector<std::string> stages = present(stages_of_step, report);
  std::string text = fmt::format(
      "steps of {}, {}: million particle-steps a second, memory traffic of them and its share of the triad, data kept, "
      "and what stages take of a step\n{:>10} {:>8} {:>8} {:>8} {:>9} {:>11}",
      report.rows.front().formulation, report.rows.front().integration, "particles", "threads", "M/s", "GB/s",
      "of triad", "B/particle");
  for (const std::string& stage : stages) text += fmt::format("{:>{}}", stage, width_of(stage));
  text += "\n";
  for (const BenchRow& r : report.rows) {
    const double traffic = r.particle_steps_per_second * r.bytes_per_particle_step;
    text += fmt::format("{:>10} {:>8} {:>8.2f} {:>8.1f} {:>8.0f}% {:>11.0f}", r.particles, r.threads,
                        1e-6 * r.particle_steps_per_second, 1e-9 * traffic,
                        100.0 * traffic / report.triad_bytes_per_second.at(r.threads), r.bytes_per_particle);
    for (const std::string& stage : stages)
      text += fmt::format("{:>{}.0f}%", 100.0 * seconds_of(r, stage) / seconds_of(r, "step"), width_of(stage) - 1);
    text += "\n";
  }
  return text;
}

std::string table_of_setup(const BenchReport& report) {
  const std::vector<std::string> stages = present(stages_of_setup, report);
  std::string text = fmt::format("set-up: seconds in all and of its stages, memory at its peak\n{:>10} {:>8} {:>8}",
                                 "particles", "threads", "s");
  for (const std::string& stage : stages) text += fmt::format("{:>{}}", stage, width_of(stage));
  text += fmt::format(" {:>11}\n", "B/particle");
  for (const BenchRow& r : report.rows) {
    text += fmt::format("{:>10} {:>8} {:>8.2f}", r.particles, r.threads, r.setup_seconds);
    for (const std::string& stage : stages) text += fmt::format("{:>{}.2f}", seconds_of(r, stage), width_of(stage));
    text += fmt::format(" {:>11}\n", r.setup_peak_bytes ? fmt::format("{:.0f}", *r.setup_peak_bytes) : "unknown");
  }
  return text;
}

std::string speed_table(const BenchReport& report) {
  std::string text;
  for (const auto& [threads, bandwidth] : report.triad_bytes_per_second)
    text += fmt::format("triad on {} thread{}: {:.1f} GB/s\n", threads, threads == 1 ? "" : "s", 1e-9 * bandwidth);
  return text + "\n" + table_of_steps(report) + "\n" + table_of_setup(report);
}

std::string accuracy_conclusion(const AccuracyForTime& a) {
  const std::string start = fmt::format("{}, {}, {:g}% error:", a.formulation, a.integration, 100.0 * wanted_error);
  if (!a.to_wanted_error) return fmt::format("{} no estimate, the errors do not fall\n", start);
  return fmt::format("{} {}{:.3g} s{}\n", start, a.to_wanted_error->upper_bound ? "at most " : "",
                     a.to_wanted_error->seconds, a.to_wanted_error->extrapolated ? " (extrapolated)" : "");
}

std::string accuracy_table(const std::vector<AccuracyForTime>& accuracy) {
  std::string text = fmt::format(
      "cantilever, error of the tip's path over 0..1 s\n{:>12} {:>13} {:>8} {:>10} {:>10} {:>8} {:>10} {:>8}\n",
      "formulation", "integration", "threads", "per metre", "particles", "steps", "steps s", "error");
  for (const AccuracyForTime& a : accuracy)
    for (const AccuracyRow& r : a.rows)
      text += fmt::format("{:>12} {:>13} {:>8} {:>10} {:>10} {:>8} {:>10.3g} {:>7.2f}%\n", a.formulation, a.integration,
                          a.threads, r.per_metre, r.particles, r.steps, r.seconds, 100.0 * r.error);
  for (const AccuracyForTime& a : accuracy) text += accuracy_conclusion(a);
  return text;
}

}  // namespace

std::string to_json(const BenchReport& report) {
  nlohmann::ordered_json j;
  j["triad_bytes_per_second"] = nlohmann::ordered_json::object();
  for (const auto& [threads, bandwidth] : report.triad_bytes_per_second)
    j["triad_bytes_per_second"][std::to_string(threads)] = bandwidth;
  j["results"] = nlohmann::ordered_json::array();
  for (const BenchRow& r : report.rows) {
    j["results"].push_back({{"particles", r.particles},
                            {"threads", r.threads},
                            {"formulation", r.formulation},
                            {"integration", r.integration},
                            {"particle_steps_per_second", r.particle_steps_per_second},
                            {"bytes_per_particle_step", r.bytes_per_particle_step},
                            {"bytes_per_particle", r.bytes_per_particle},
                            {"setup_seconds", r.setup_seconds},
                            {"stages", r.stages}});
    if (r.setup_peak_bytes) j["results"].back()["setup_peak_bytes_per_particle"] = *r.setup_peak_bytes;
  }
  for (const AccuracyForTime& a : report.accuracy) j["accuracy_for_time"].push_back(accuracy_json(a));
  return j.dump(2) + "\n";
}

std::string to_table(const BenchReport& report) {
  std::string text;
  if (!report.rows.empty()) text += speed_table(report);
  if (!report.rows.empty() && !report.accuracy.empty()) text += "\n";
  if (!report.accuracy.empty()) text += accuracy_table(report.accuracy);
  return text;
}

}  // namespace tessera
