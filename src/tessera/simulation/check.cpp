#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tessera/output/progress.hpp"
#include "tessera/output/summary.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/simulation/engine.hpp"
#include "tessera/simulation/inertia.hpp"
#include "tessera/simulation/recorder.hpp"
#include "tessera/simulation/run.hpp"

namespace tessera {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Wall-clock seconds of one evaluation of the forces, the best of a few.
double seconds_per_step(const Model& model) {
  State state = reference_state(model.system);
  Forces forces(model.system);
  double best = 1e300;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    forces.evaluate(state, {model.loads.motion.positions(), {}, model.loads.gravity}, 0.0);
    best = std::min(best, seconds_since(start));
  }
  return best;
}

/// Throws InputError where a probe finds nothing to read.
void refuse_useless_probes(const Case& c, const Model& model, const Engine& engine) {
  if (!c.probes.empty()) HistoryRows(c, model, engine, engine.snapshot());
}

struct Findings {
  std::int64_t particles = 0, bonds = 0, boundary_faces = 0, constrained = 0;
  double volume = 0.0, shortest = 0.0, dt = 0.0, limit = 0.0, setup_seconds = 0.0, run_seconds = 0.0;
  double steps = 0.0;
  std::int64_t memory = 0;
  IntegrationSummary integration;
  Identities identities;
  std::vector<SideRow> sides;
  Quality quality;
  std::vector<std::string> notes;
};

Findings examine(const Case& c) {
  const auto start = std::chrono::steady_clock::now();
  Model model = build_model(c);
  Findings f;
  f.setup_seconds = seconds_since(start);
  const Discretization& d = model.system.d;
  f.particles = d.particles();
  f.bonds = model.system.tiles.bonds / 2;
  f.boundary_faces = model.boundary_faces;
  f.constrained = static_cast<std::int64_t>(d.nodes.size() + d.constraints.size());
  f.volume = d.body_volume;
  f.shortest = model.system.shortest_length;
  f.integration = integration_of(model);
  f.identities = model.identities;
  f.sides = model.sides;
  f.quality = model.quality;
  f.notes = model.notes;
  // A copy that is never refused: check also tells the limit to those whose fixed step is too long.
  TimeSpec spec = c.time;
  if (auto* fixed = std::get_if<FixedStep>(&spec.step)) fixed->force = true;
  const Engine engine(model, spec);
  refuse_useless_probes(c, model, engine);
  const StepControl::Memory& step = engine.step_control().memory();
  f.dt = step.dt;
  if (const auto* fixed = std::get_if<FixedStep>(&c.time.step); fixed && !fixed->force && step.dt > step.limit)
    f.notes.push_back(fmt::format(
        "warning: a run refuses time.step = {:g} s, which is above the spectral limit of {:g} s; take a smaller one, "
        "\"auto\" or \"auto-spectral\" (or force = true)",
        step.dt, step.limit));
  f.limit = stable_step(
      model.system, SpectralEstimator(model.system, inertia(model, engine.mass_scaling()))
                        .largest_frequency(reference_state(model.system), model.loads.motion.positions(), f.shortest));
  f.steps = c.time.end > 0.0 ? std::ceil(c.time.end / f.dt) : 0.0;
  f.run_seconds = f.steps * seconds_per_step(model);
  f.memory = peak_memory_bytes();
  return f;
}

std::string to_text(const Findings& f) {
  std::string text = fmt::format(
      "particles        {}\nbonds            {}\nboundary faces   {} ({} faces or particles with prescribed motion)\n"
      "volume           {:.10g} m3\nshortest bond    {:.4g} m\n",
      f.particles, f.bonds, f.boundary_faces, f.constrained, f.volume, f.shortest);
  text += fmt::format("integration      {}\n", integration_text(f.integration, f.particles));
  text += fmt::format("time step        {:.4g} s (spectral limit {:.4g} s)\nsteps            {:.0f}\n", f.dt, f.limit,
                      f.steps);
  text += fmt::format(
      "set-up           {:.2g} s\nestimated run    {}\nmemory           {:.3g} MB\nidentities (largest relative "
      "violation)\n",
      f.setup_seconds, duration_text(f.run_seconds), static_cast<double>(f.memory) / 1e6);
  for (const auto& [name, value] : f.identities) text += fmt::format("  {:<14} {:.1e}\n", name, value);
  text += to_text(f.quality);
  text += to_text(f.sides);
  for (const std::string& note : f.notes) text += note + "\n";
  return text;
}

nlohmann::ordered_json to_json(const SideRow& row) {
  const auto list = [](const Vec3& X) { return std::array{X.x, X.y, X.z}; };
  return {{"body", row.body},
          {"names", row.names},
          {"area", row.side.area},
          {"faces", row.faces},
          {"triangles", row.side.triangles},
          {"normal", list(row.side.normal)},
          {"min", list(row.side.box.lower)},
          {"max", list(row.side.box.upper)}};
}

std::string to_json(const Findings& f) {
  nlohmann::ordered_json j;
  j["particles"] = f.particles;
  j["bonds"] = f.bonds;
  j["boundary_faces"] = f.boundary_faces;
  j["constrained"] = f.constrained;
  j["volume"] = f.volume;
  j["shortest_bond"] = f.shortest;
  j["integration"] = {{"kind", f.integration.kind}, {"unresolved_cells", f.integration.unresolved_cells}};
  j["dt"] = f.dt;
  j["dt_limit"] = f.limit;
  j["steps"] = f.steps;
  j["setup_seconds"] = f.setup_seconds;
  j["estimated_run_seconds"] = f.run_seconds;
  j["peak_memory_bytes"] = f.memory;
  j["identities"] = f.identities;
  j["sides"] = nlohmann::ordered_json::array();
  for (const SideRow& row : f.sides) j["sides"].push_back(to_json(row));
  j["quality"] = to_json(f.quality);
  j["notes"] = f.notes;
  return j.dump(2) + "\n";
}

}  // namespace

CheckReport check_case(const Case& c, int threads) {
  parallel::set_threads(threads);
  const Findings findings = examine(c);
  require(findings.identities);
  return {to_text(findings), to_json(findings)};
}

}  // namespace tessera
