#pragma once

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tessera/output/chunked_array.hpp"
#include "tessera/output/image_memory.hpp"
#include "tessera/output/output_file.hpp"

namespace tessera {

/// An HDF5 identifier that closes itself.
class Hdf5Id {
 public:
  Hdf5Id() = default;
  Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Id& operator=(Hdf5Id&& other) noexcept;
  ~Hdf5Id();

  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Keeps HDF5 from printing its own error messages; ours say what matters.
void silence_hdf5();

/// How arrays are stored: by shuffle and gzip, or as they are in memory.
enum class Hdf5Storage { compressed, plain };

/// An HDF5 file that is put together in memory and saved as a whole. HDF5 itself never meets a full disk: after a
/// failed write it can neither close the file nor end the process cleanly.
class Hdf5Image {
 public:
  /// `memory` belongs to the image as long as that lives.
  Hdf5Image(Hdf5Storage storage, ImageMemory& memory);

  void group(const std::string& name);
  /// Arrays with `columns` > 1 are tables of size() / columns rows.
  void array(const std::string& name, std::span<const double> values, int columns = 1);
  void array(const std::string& name, std::span<const std::int32_t> values, int columns = 1);
  void array(const std::string& name, std::span<const std::int64_t> values, int columns = 1);
  void array(const std::string& name, std::span<const std::uint8_t> values, int columns = 1);
  /// An array that is compressed already.
  void array(const std::string& name, const ChunkedArray& values);
  /// A second name for what is at `existing`.
  void link(const std::string& existing, const std::string& name);
  void text(const std::string& name, const std::string& value);
  void attribute(const std::string& group, const std::string& name, std::span<const std::int64_t> values);
  void attribute(const std::string& group, const std::string& name, const std::string& value);

  /// Writes the file. Throws RunError when that fails.
  void save(const std::string& path, Durability durability);

 private:
  void array(const std::string& name, hid_t type, const void* values, std::size_t count, std::size_t item_bytes,
             int columns);

  Hdf5Storage storage_;
  Hdf5Id file_;
};

}  // namespace tessera
