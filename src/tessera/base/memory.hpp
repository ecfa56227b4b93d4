#pragma once

#include <optional>

namespace tessera {

/// Memory that programs can still take without swapping [bytes]. Nothing where the system does not say (Linux does).
std::optional<double> available_memory();

/// A line such as "VmHWM:   1234 kB" of a file of the system, in bytes.
std::optional<double> line_of_memory(const char* path, const char* name);

}  // namespace tessera
