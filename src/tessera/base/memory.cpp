#include "tessera/base/memory.hpp"

#include <fstream>
#include <string>

namespace tessera {

std::optional<double> line_of_memory(const char* path, const char* name) {
  std::ifstream file(path);
  const std::string wanted = std::string(name) + ":";
  for (std::string word; file >> word;) {
    double kilobytes = 0.0;
    if (word == wanted && file >> kilobytes) return 1024.0 * kilobytes;
  }
  return std::nullopt;
}

std::optional<double> available_memory() { return line_of_memory("/proc/meminfo", "MemAvailable"); }

}  // namespace tessera
