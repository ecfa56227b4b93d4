#pragma once

#include <string>
#include <vector>

#include "tessera/simulation/case.hpp"

namespace tessera {

/// A case together with what its author should know about.
struct CaseFile {
  Case value;
  std::vector<std::string> unused;  // one line about each key that was given where it has no effect
};

/// Reads a case file (TOML) and applies overrides of the form "key=value", as in "body.0.particles.jitter=0.1".
/// Numbers are in SI units afterwards, defaults filled in, and file names absolute; relative ones start at the case
/// file. Throws InputError that says where, which key, what was found and what is allowed.
CaseFile read_case_file(const std::string& path, const std::vector<std::string>& overrides);

/// The same for text; `path` is the name that messages show, and where relative file names start.
CaseFile read_case_text(const std::string& text, const std::string& path, const std::vector<std::string>& overrides);

/// The case alone.
Case read_case(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace tessera
