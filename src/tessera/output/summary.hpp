#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tessera/output/displacement_error.hpp"
#include "tessera/output/quality.hpp"
#include "tessera/output/snapshot.hpp"

namespace tessera {

/// Wall-clock time spent [s].
struct WallSeconds {
  double setup = 0.0;
  double steps = 0.0;
  double time_step = 0.0;  // choosing the step, at the start and later; in none of the others
  double output = 0.0;
};

/// What choosing the step has cost, and what it found.
struct StepControlSummary {
  std::int64_t evaluations = 0;  // of the forces
  double limit = 0.0;            // lower bound of the stable step, of the last estimate [s]
};

/// What mass scaling has done to a model.
struct MassScalingSummary {
  double step = 0.0;           // that was wanted [s]
  double added = 0.0;          // [kg]
  double added_share = 0.0;    // of the true mass
  std::int64_t particles = 0;  // made heavier
  std::string body;            // of the particle that is most affected
  std::int64_t particle = 0;   // its number in that body
  double largest_factor = 1.0;
  std::int64_t evaluations = 0;  // of the forces, to find the masses; part of the set-up
  double kinetic_share = 0.0;    // largest share of the kinetic energy after the first tenth of the run
};

/// How the strain energy of cells was integrated.
struct IntegrationSummary {
  std::string kind = "nodal";         // or "cell" or "second-order"
  std::int64_t unresolved_cells = 0;  // cell: without neighbours in some direction, along which F counts as constant;
                                      // second-order: that took cell integration
};

/// The result of a run in numbers: the content of summary.json, key for key.
struct Summary {
  std::string version;    // of the program
  std::string case_file;  // key `case`
  std::string status;     // "done", "running", "failed" or "interrupted"
  std::string message;    // why it failed; the key is left out when empty
  std::int64_t particles = 0;
  std::int64_t bonds = 0;
  std::int64_t boundary_faces = 0;
  std::int64_t steps = 0;
  double dt = 0.0;    // last step [s]
  double time = 0.0;  // reached [s]
  WallSeconds wall_seconds;
  double particle_steps_per_second = 0.0;
  std::int64_t peak_memory_bytes = 0;
  EnergyLedger energy;
  Momentum momentum;                                // at the end
  Momentum momentum_change;                         // since the start
  std::map<std::string, DisplacementError> errors;  // by name of the reference
  std::map<std::string, double> identities;         // largest violation of each, relative
  Quality quality;                                  // of particles and cells
  StepControlSummary step_control;
  IntegrationSummary integration;
  std::optional<MassScalingSummary> mass_scaling;  // the key is left out without it
  double max_force_residual = 0.0;                 // largest |force| on a free particle at the end [N]
  std::vector<std::string> warnings;               // what makes the result doubtful, with what to do
};

/// The summary as JSON text. Numbers that are not finite become null.
std::string to_json(const Summary& summary);

/// What the energies say against a result: the bonds, which only stabilise, held more of the strain energy than they do
/// in any sound run. Empty where they did not.
std::string warning_of_bonds(const EnergyLedger& e);

/// Parts of it for people, in one line.
std::string mass_scaling_text(const MassScalingSummary& m);
std::string integration_text(const IntegrationSummary& integration, std::int64_t particles);

/// Replaces the file `path` by the summary. Throws RunError when it cannot be written.
void write_summary(const std::string& path, const Summary& summary);

/// Largest memory that this process has used so far [bytes].
std::int64_t peak_memory_bytes();

}  // namespace tessera
