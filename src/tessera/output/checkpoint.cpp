#include "tessera/output/checkpoint.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "tessera/base/error.hpp"
#include "tessera/output/hdf5_image.hpp"

namespace tessera {

namespace {

constexpr std::int64_t checkpoint_version = 1;
constexpr const char* version_key = "tessera_checkpoint";
constexpr const char* checksum_key = "checksum";
constexpr const char* damaged = "the checkpoint is truncated or damaged; go on from another one or start the run again";

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw InputError({path, 0, 0, ""}, reason);
}

std::uint32_t crc(std::uint32_t start, const void* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(start, static_cast<const Bytef*>(bytes), size));
}

template <class Map>
std::uint32_t crc_of_entries(std::uint32_t sum, const Map& entries) {
  const std::uint64_t count = entries.size();
  sum = crc(sum, &count, sizeof count);
  for (const auto& [name, values] : entries) {
    const std::array<std::uint64_t, 2> sizes = {name.size(), values.size()};
    sum = crc(sum, sizes.data(), sizeof sizes);
    sum = crc(sum, name.data(), name.size());
    if (!values.empty()) sum = crc(sum, values.data(), values.size() * sizeof(values[0]));
  }
  return sum;
}

/// CRC-32 of all names, sizes and values. HDF5's own checksums leave out which data belong to which name.
std::int64_t checksum(const Checkpoint& checkpoint) {
  std::uint32_t sum = crc_of_entries(0, checkpoint.arrays);
  sum = crc_of_entries(sum, checkpoint.integers);
  return crc_of_entries(sum, checkpoint.texts);
}

template <class Map>
const typename Map::mapped_type& entry(const Map& map, const Checkpoint& checkpoint, const std::string& name) {
  const auto found = map.find(name);
  if (found == map.end())
    fail(checkpoint.source,
         fmt::format("the checkpoint has no entry \"{}\"; it belongs to another version or case", name));
  return found->second;
}

template <class Values>
const Values& of_size(const Values& values, const Checkpoint& checkpoint, const std::string& name, std::size_t size) {
  if (values.size() != size)
    fail(checkpoint.source, fmt::format("entry \"{}\" of the checkpoint has {} values instead of {}; it belongs to "
                                        "another case",
                                        name, values.size(), size));
  return values;
}

void check_name(const std::string& path, const std::string& name) {
  if (name.empty() || name == "." || name.find('/') != std::string::npos)
    throw RunError(fmt::format("{}: \"{}\" cannot be the name of an entry", path, name));
}

herr_t append_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

/// Reads the entries of one open file; every failure of HDF5 means a damaged file.
class Reader {
 public:
  Reader(const std::string& path, Hdf5Id file)
      : path_(path), file_(std::move(file)), file_bytes_(std::filesystem::file_size(path)) {}

  std::vector<std::string> names(const std::string& group) const {
    std::vector<std::string> names;
    hsize_t first = 0;
    good(H5Literate_by_name(file_.get(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, &first, append_name, &names,
                            H5P_DEFAULT));
    return names;
  }

  template <class T>
  std::vector<T> array(const std::string& name, hid_t type) const {
    const Hdf5Id data = open(name);
    const Hdf5Id space(good(H5Dget_space(data.get())), H5Sclose);
    const auto count = static_cast<std::size_t>(good(H5Sget_simple_extent_npoints(space.get())));
    good(count <= file_bytes_ / sizeof(T) ? 0 : -1);
    std::vector<T> values(count);
    if (!values.empty()) good(H5Dread(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
  }

  std::string text(const std::string& name) const {
    const Hdf5Id data = open(name);
    const Hdf5Id type(good(H5Dget_type(data.get())), H5Tclose);
    std::string value(H5Tget_size(type.get()), '\0');
    good(H5Dread(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()));
    value.resize(value.find_last_not_of('\0') + 1);
    return value;
  }

  std::int64_t version() const {
    if (H5Aexists(file_.get(), version_key) <= 0) fail(path_, "is not a checkpoint of tessera");
    return attribute(version_key);
  }

  std::int64_t attribute(const char* name) const {
    const Hdf5Id attribute(good(H5Aopen(file_.get(), name, H5P_DEFAULT)), H5Aclose);
    std::int64_t value = 0;
    good(H5Aread(attribute.get(), H5T_NATIVE_INT64, &value));
    return value;
  }

  template <class T>
  T good(T result) const {
    if (result < 0) fail(path_, damaged);
    return result;
  }

 private:
  Hdf5Id open(const std::string& name) const {
    return {good(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT)), H5Dclose};
  }

  const std::string& path_;
  Hdf5Id file_;
  std::uintmax_t file_bytes_;
};

Reader open_checkpoint(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> probe(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!probe) fail(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  silence_hdf5();
  if (H5Fis_hdf5(path.c_str()) <= 0) fail(path, "is not a checkpoint: no HDF5 file");
  Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.valid()) fail(path, damaged);
  return {path, std::move(file)};
}

}  // namespace

const std::vector<double>& Checkpoint::array(const std::string& name) const { return entry(arrays, *this, name); }
const std::vector<std::int64_t>& Checkpoint::integer(const std::string& name) const {
  return entry(integers, *this, name);
}
const std::string& Checkpoint::text(const std::string& name) const { return entry(texts, *this, name); }

const std::vector<double>& Checkpoint::array(const std::string& name, std::size_t size) const {
  return of_size(array(name), *this, name, size);
}
const std::vector<std::int64_t>& Checkpoint::integer(const std::string& name, std::size_t size) const {
  return of_size(integer(name), *this, name, size);
}

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  ImageMemory memory;
  Hdf5Image file(Hdf5Storage::plain, memory);
  file.attribute("/", version_key, std::array<std::int64_t, 1>{checkpoint_version});
  file.attribute("/", checksum_key, std::array<std::int64_t, 1>{checksum(checkpoint)});
  for (const char* group : {"/arrays", "/integers", "/texts"}) file.group(group);
  for (const auto& [name, values] : checkpoint.arrays) {
    check_name(path, name);
    file.array("/arrays/" + name, values);
  }
  for (const auto& [name, values] : checkpoint.integers) {
    check_name(path, name);
    file.array("/integers/" + name, values);
  }
  for (const auto& [name, value] : checkpoint.texts) {
    check_name(path, name);
    file.text("/texts/" + name, value);
  }
  file.save(path, Durability::power);
}

Checkpoint read_checkpoint(const std::string& path) {
  const Reader reader = open_checkpoint(path);
  if (const std::int64_t version = reader.version(); version != checkpoint_version)
    fail(path, fmt::format("is a checkpoint of format {}, this program reads format {}", version, checkpoint_version));
  Checkpoint checkpoint;
  checkpoint.source = path;
  for (const std::string& name : reader.names("/arrays"))
    checkpoint.arrays[name] = reader.array<double>("/arrays/" + name, H5T_NATIVE_DOUBLE);
  for (const std::string& name : reader.names("/integers"))
    checkpoint.integers[name] = reader.array<std::int64_t>("/integers/" + name, H5T_NATIVE_INT64);
  for (const std::string& name : reader.names("/texts")) checkpoint.texts[name] = reader.text("/texts/" + name);
  if (reader.attribute(checksum_key) != checksum(checkpoint)) fail(path, damaged);
  return checkpoint;
}

}  // namespace tessera
