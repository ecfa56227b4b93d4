#include "tessera/output/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "tessera/output/output_file.hpp"

namespace tessera {

namespace {

// In sound runs bonds hold a few per cent of the strain energy, a tenth with very few cells through the thickness;
// where cells fold or a body has gone through itself, a fifth to a half.
constexpr double most_sound_contact_share = 0.2;

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

Json list(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json energy(const EnergyLedger& e) {
  return {{"kinetic", e.kinetic},
          {"internal", e.internal},
          {"contact", e.contact},
          {"external_work", e.external_work},
          {"dissipated", e.dissipated},
          {"relative_error", e.relative_error()},
          {"contact_share", e.contact_share()},
          {"largest_contact_share", e.largest_contact_share()}};
}

Json mass_scaling(const MassScalingSummary& m) {
  return {{"step", m.step},
          {"added_mass", m.added},
          {"added_share", m.added_share},
          {"particles", m.particles},
          {"most_affected", {{"body", m.body}, {"particle", m.particle}, {"factor", m.largest_factor}}},
          {"evaluations", m.evaluations},
          {"kinetic_share", m.kinetic_share}};
}

Json errors(const std::map<std::string, DisplacementError>& errors) {
  Json json = Json::object();
  for (const auto& [name, error] : errors)
    json[name] = {{"displacement_l2", error.l2},
                  {"displacement_l2_measure", error.measure == ErrorMeasure::relative ? "relative" : "absolute"},
                  {"displacement_max", error.max}};
  return json;
}

}  // namespace

std::string to_json(const Summary& s) {
  Json json = {{"version", s.version}, {"case", s.case_file}, {"status", s.status}};
  if (!s.message.empty()) json["message"] = s.message;
  json["particles"] = s.particles;
  json["bonds"] = s.bonds;
  json["boundary_faces"] = s.boundary_faces;
  json["steps"] = s.steps;
  json["dt"] = s.dt;
  json["time"] = s.time;
  json["wall_seconds"] = {{"setup", s.wall_seconds.setup},
                          {"steps", s.wall_seconds.steps},
                          {"time_step", s.wall_seconds.time_step},
                          {"output", s.wall_seconds.output}};
  json["particle_steps_per_second"] = s.particle_steps_per_second;
  json["peak_memory_bytes"] = s.peak_memory_bytes;
  json["energy"] = energy(s.energy);
  json["momentum"] = {{"linear", list(s.momentum.linear)},
                      {"angular", list(s.momentum.angular)},
                      {"linear_change", list(s.momentum_change.linear)},
                      {"angular_change", list(s.momentum_change.angular)}};
  json["errors"] = errors(s.errors);
  json["identities"] = Json::object();
  for (const auto& [name, violation] : s.identities) json["identities"][name] = violation;
  json["quality"] = to_json(s.quality);
  json["step_control"] = {{"evaluations", s.step_control.evaluations}, {"limit", s.step_control.limit}};
  json["integration"] = {{"kind", s.integration.kind}, {"unresolved_cells", s.integration.unresolved_cells}};
  if (s.mass_scaling) json["mass_scaling"] = mass_scaling(*s.mass_scaling);
  json["max_force_residual"] = s.max_force_residual;
  json["warnings"] = s.warnings;
  // Names come from users: bytes that are no UTF-8 are replaced, not refused.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string warning_of_bonds(const EnergyLedger& e) {
  const double share = e.largest_contact_share();
  if (!(share > most_sound_contact_share)) return {};
  return fmt::format(
      "the bonds held {:.0f}% of the strain energy (energy.largest_contact_share; up to {:.0f}% are sound): they only "
      "stabilise what the cells' strains do not see, so the result is theirs more than the material's. See whether "
      "cells have folded or the body has gone through itself, which no contact prevents; take finer particles or less "
      "load, and trust the time before",
      100.0 * share, 100.0 * most_sound_contact_share);
}

std::string mass_scaling_text(const MassScalingSummary& m) {
  return fmt::format(
      "mass scaling for steps of {:g} s: {:.3g}% of the mass added, to {} particles (particle {} of body \"{}\" is "
      "{:.3g} "
      "times as heavy); kinetic energy at most {:.2g}% of the energy after the first tenth of the run",
      m.step, 100.0 * m.added_share, m.particles, m.particle, m.body, m.largest_factor, 100.0 * m.kinetic_share);
}

std::string integration_text(const IntegrationSummary& integration, std::int64_t particles) {
  if (integration.unresolved_cells == 0) return integration.kind;
  const bool second = integration.kind == "second-order";
  return fmt::format("{}; {} of {} cells, with too few neighbours in some direction, take {}", integration.kind,
                     integration.unresolved_cells, particles, second ? "cell" : "nodal there");
}

void write_summary(const std::string& path, const Summary& summary) {
  replace_file(path, to_json(summary), Durability::power);
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{1024} * usage.ru_maxrss;
}

}  // namespace tessera
