#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tessera {

/// Everything that a run needs to go on bit by bit: named arrays and texts. Names must not be empty or hold '/'.
struct Checkpoint {
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, std::vector<std::int64_t>> integers;
  std::map<std::string, std::string> texts;  // without NUL characters at the end
  std::string source;                        // the file it was read from

  /// The entry called `name`. Throws InputError that names the file and the entry when it is missing.
  const std::vector<double>& array(const std::string& name) const;
  const std::vector<std::int64_t>& integer(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  /// As above, and the entry has `size` values.
  const std::vector<double>& array(const std::string& name, std::size_t size) const;
  const std::vector<std::int64_t>& integer(const std::string& name, std::size_t size) const;
};

/// Writes `checkpoint` as an HDF5 file: groups `arrays`, `integers`, `texts`, and a checksum over all of them. It
/// replaces the file `path` only when it is complete and on the disk. Throws RunError when that fails.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Reads what write_checkpoint() wrote. Throws InputError that names the file when it is missing, no HDF5 file,
/// truncated, damaged, no checkpoint, or of a version that this program does not read.
Checkpoint read_checkpoint(const std::string& path);

}  // namespace tessera
