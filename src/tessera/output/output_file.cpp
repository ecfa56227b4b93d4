#include "tessera/output/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "tessera/base/error.hpp"

namespace tessera {

namespace {

/// A rename is safe from a loss of power only when the folder is on the disk, too.
void sync_folder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return;  // some file systems do not open folders; the file itself is complete
  ::fsync(descriptor);
  ::close(descriptor);
}

/// Writes whole pages past the file cache; returns how many bytes, perhaps none. What stops it, who writes the rest
/// will meet again.
std::size_t write_pages(int descriptor, std::string_view bytes) {
#ifdef O_DIRECT
  constexpr std::size_t page = 4096;
  const int flags = ::fcntl(descriptor, F_GETFL);
  const bool aligned = reinterpret_cast<std::uintptr_t>(bytes.data()) % page == 0;
  if (!aligned || ::fcntl(descriptor, F_SETFL, flags | O_DIRECT) != 0) return 0;
  const std::size_t whole = bytes.size() / page * page;
  std::size_t done = 0;
  for (ssize_t n = 1; done < whole && n > 0; done += static_cast<std::size_t>(std::max<ssize_t>(n, 0)))
    n = ::write(descriptor, bytes.data() + done, whole - done);
  ::fcntl(descriptor, F_SETFL, flags);
  return done;
#else
  return 0;
#endif
}

}  // namespace

std::string temporary_name(const std::string& path) { return path + ".tmp"; }

void throw_write_error(const std::string& path) {
  throw RunError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  file_.reset(std::fopen(temporary_name(path_).c_str(), "wb"));
  if (!file_) throw_write_error(path_);
}

OutputFile::~OutputFile() {
  if (!file_) return;
  file_.reset();
  std::remove(temporary_name(path_).c_str());
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) throw_write_error(path_);
}

void OutputFile::write_past_cache(std::string_view bytes) {
  if (std::fflush(file_.get()) != 0) throw_write_error(path_);
  write(bytes.substr(write_pages(::fileno(file_.get()), bytes)));
}

void OutputFile::commit(Durability durability) {
  if (std::fflush(file_.get()) != 0) throw_write_error(path_);
  if (durability == Durability::power && ::fsync(::fileno(file_.get())) != 0) throw_write_error(path_);
  const bool closed = std::fclose(file_.release()) == 0;
  const bool named = closed && std::rename(temporary_name(path_).c_str(), path_.c_str()) == 0;
  if (!named) {
    const int reason = errno;
    std::remove(temporary_name(path_).c_str());
    errno = reason;
    throw_write_error(path_);
  }
  if (durability == Durability::power) sync_folder(path_);
}

void replace_file(const std::string& path, std::string_view content, Durability durability) {
  OutputFile file(path);
  file.write(content);
  file.commit(durability);
}

std::string content_of_file(const std::string& path) {
  const auto fail = [&path]() {
    throw InputError({path, 0, 0, ""}, fmt::format("cannot be read: {}", std::strerror(errno)));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail();
  std::string content;
  char buffer[65536];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file.get())) content.append(buffer, n);
  if (std::ferror(file.get())) fail();
  return content;
}

}  // namespace tessera
