#include "tessera/bench/memory.hpp"

#include <fstream>

#include "tessera/base/memory.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace tessera {

namespace {

std::optional<double> status(const char* name) { return line_of_memory("/proc/self/status", name); }

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
