#include "tessera/bench/memory.hpp"

#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace tessera {

namespace {

/// A line such as "VmHWM:   1234 kB" of a file of the system, in bytes.
std::optional<double> line_of(const char* path, const std::string& name) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    double kilobytes = 0.0;
    if (word == name + ":" && file >> kilobytes) return 1024.0 * kilobytes;
  }
  return std::nullopt;
}

std::optional<double> status(const std::string& name) { return line_of("/proc/self/status", name); }

/// Makes the peak start anew from what is resident now.
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

/// Memory that was freed but not handed back would hide as much of what is measured.
void hand_back_free_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace

std::optional<double> available_memory() { return line_of("/proc/meminfo", "MemAvailable"); }

PeakMemory::PeakMemory() {
  hand_back_free_memory();
  if (reset_peak()) before_ = status("VmRSS");
}

std::optional<double> PeakMemory::bytes() const {
  const std::optional<double> peak = status("VmHWM");
  if (!before_ || !peak) return std::nullopt;
  return *peak - *before_;
}

}  // namespace tessera
