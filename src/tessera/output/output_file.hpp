#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace tessera {

/// What a committed file outlives: the end of the process, or also the loss of power (waits for the disk).
enum class Durability { process, power };

/// The name under which `path` is written until it is complete.
std::string temporary_name(const std::string& path);

/// A file that appears under its name only when it is complete: written beside it, renamed by commit(). Without
/// commit() what stood under the name before stays. Every function throws RunError with path and reason (disk full, no
/// permission).
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// As write(), for many bytes that nobody reads soon. Where the system can, whole pages go to the disk past the file
  /// cache, if `bytes` begin at a page of memory: that saves the processor a copy and waits for the disk instead.
  void write_past_cache(std::string_view bytes);
  void commit(Durability durability);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// Replaces the file `path` by `content` in one go.
void replace_file(const std::string& path, std::string_view content, Durability durability = Durability::process);

/// The whole content of the file `path`. Throws InputError that names the file when it cannot be read.
std::string content_of_file(const std::string& path);

/// Throws RunError: "PATH: cannot be written: REASON", the reason from errno.
[[noreturn]] void throw_write_error(const std::string& path);

}  // namespace tessera
