#pragma once

#include <string>

#include "tessera/simulation/case.hpp"

namespace tessera {

/// How a run is carried out, apart from what the case says.
struct RunOptions {
  std::string directory;   // result folder
  int threads = 0;         // 0: as the environment says
  bool overwrite = false;  // replace the folder if it exists
  bool resume = false;     // go on from its checkpoint
  bool quiet = false;      // no progress
};

/// Runs a case from set-up to summary. Throws Error subclasses; the result folder then holds what was written so
/// far, and for RunError and Interrupted a checkpoint.
void run_case(const Case& c, const RunOptions& options);

/// What `check` found, for printing and as JSON text.
struct CheckReport {
  std::string text;
  std::string json;
};

/// Builds particles, cells and bonds, checks the identities of the method and estimates the cost; runs no step.
/// Throws GeometryError when an identity does not hold.
CheckReport check_case(const Case& c, int threads);

}  // namespace tessera
