#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tessera/output/displacement_error.hpp"
#include "tessera/output/snapshot.hpp"

namespace tessera {

/// Wall-clock time spent [s].
struct WallSeconds {
  double setup = 0.0;
  double steps = 0.0;
  double output = 0.0;
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
  double max_force_residual = 0.0;                  // largest |force| on a free particle at the end [N]
};

/// The summary as JSON text. Numbers that are not finite become null.
std::string to_json(const Summary& summary);

/// Replaces the file `path` by the summary. Throws RunError when it cannot be written.
void write_summary(const std::string& path, const Summary& summary);

/// Largest memory that this process has used so far [bytes].
std::int64_t peak_memory_bytes();

}  // namespace tessera
