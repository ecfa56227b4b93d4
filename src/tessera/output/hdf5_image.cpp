#include "tessera/output/hdf5_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>

#include "tessera/base/error.hpp"

namespace tessera {

namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 18;  // fits into a core's cache
constexpr std::size_t image_growth = std::size_t{1} << 20;
constexpr unsigned gzip_level = 1;  // higher levels save little on doubles and take several times longer

/// In memory only the lack of memory makes HDF5 fail.
hid_t good(hid_t id) {
  if (id < 0) throw RunError("HDF5 could not put a file together: out of memory");
  return id;
}

Hdf5Id dataspace(std::span<const hsize_t> sizes) {
  return {good(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr)), H5Sclose};
}

/// Properties for something new, without the time of day: equal content gives equal bytes.
Hdf5Id timeless(hid_t kind) {
  Hdf5Id properties(good(H5Pcreate(kind)), H5Pclose);
  good(H5Pset_obj_track_times(properties.get(), false));
  return properties;
}

/// HDF5 takes files of one name for the same file, and looks for one on the disk; these exist nowhere.
std::string unused_name() {
  static std::atomic<int> images = 0;
  return fmt::format("/dev/null/tessera_image_{}", images++);
}

Hdf5Id scalar_space() { return {good(H5Screate(H5S_SCALAR)), H5Sclose}; }

Hdf5Id string_type(const std::string& value) {
  Hdf5Id type(good(H5Tcopy(H5T_C_S1)), H5Tclose);
  good(H5Tset_size(type.get(), std::max<std::size_t>(value.size(), 1)));
  good(H5Tset_strpad(type.get(), H5T_STR_NULLPAD));
  return type;
}

hid_t native(ElementType type) {
  switch (type) {
    case ElementType::float32:
      return H5T_NATIVE_FLOAT;
    case ElementType::float64:
      return H5T_NATIVE_DOUBLE;
    case ElementType::int32:
      return H5T_NATIVE_INT32;
    case ElementType::int64:
      return H5T_NATIVE_INT64;
    case ElementType::uint8:
      break;
  }
  return H5T_NATIVE_UINT8;
}

/// Storage by shuffle and deflate in pieces of `rows` rows, of a table of `sizes`.
Hdf5Id chunked_storage(std::span<const hsize_t> sizes, hsize_t rows) {
  Hdf5Id plist = timeless(H5P_DATASET_CREATE);
  std::vector<hsize_t> chunk(sizes.begin(), sizes.end());
  chunk[0] = rows;
  good(H5Pset_chunk(plist.get(), static_cast<int>(chunk.size()), chunk.data()));
  good(H5Pset_shuffle(plist.get()));
  good(H5Pset_deflate(plist.get(), gzip_level));
  return plist;
}

Hdf5Id storage_of(Hdf5Storage storage, std::span<const hsize_t> sizes, std::size_t item_bytes) {
  if (storage == Hdf5Storage::plain || sizes[0] == 0) return timeless(H5P_DATASET_CREATE);  // chunks cannot be empty
  const std::size_t row_bytes = item_bytes * (sizes.size() > 1 ? sizes[1] : 1);
  return chunked_storage(sizes, std::clamp<hsize_t>(chunk_bytes / row_bytes, 1, sizes[0]));
}

/// Lets images grow in memory of ours.
void grow_in(ImageMemory& memory, const Hdf5Id& access) {
  H5FD_file_image_callbacks_t calls{};
  calls.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* owner) -> void* {
    return static_cast<ImageMemory*>(owner)->resized(size);
  };
  calls.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t, void* owner) -> void* {
    return static_cast<ImageMemory*>(owner)->resized(size);
  };
  calls.image_memcpy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
  };
  calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  calls.udata_copy = [](void* owner) { return owner; };
  calls.udata_free = [](void*) -> herr_t { return 0; };
  calls.udata = &memory;
  good(H5Pset_file_image_callbacks(access.get(), &calls));
}

}  // namespace

Hdf5Id& Hdf5Id::operator=(Hdf5Id&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

Hdf5Id::~Hdf5Id() {
  if (id_ >= 0) close_(id_);
}

void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Hdf5Image::Hdf5Image(Hdf5Storage storage, ImageMemory& memory) : storage_(storage) {
  silence_hdf5();
  const Hdf5Id access(good(H5Pcreate(H5P_FILE_ACCESS)), H5Pclose);
  good(H5Pset_fapl_core(access.get(), image_growth, 0));
  grow_in(memory, access);
  // From this version on most of the file's structure has checksums. (Old readers of VTKHDF want the older one.)
  if (storage == Hdf5Storage::plain) good(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18));
  const Hdf5Id creation = timeless(H5P_FILE_CREATE);
  file_ = Hdf5Id(good(H5Fcreate(unused_name().c_str(), H5F_ACC_TRUNC, creation.get(), access.get())), H5Fclose);
}

void Hdf5Image::group(const std::string& name) {
  const Hdf5Id creation = timeless(H5P_GROUP_CREATE);
  const Hdf5Id group(good(H5Gcreate2(file_.get(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT)), H5Gclose);
}

void Hdf5Image::array(const std::string& name, hid_t type, const void* values, std::size_t count,
                      std::size_t item_bytes, int columns) {
  std::vector<hsize_t> sizes = {count / static_cast<std::size_t>(columns)};
  if (columns > 1) sizes.push_back(static_cast<hsize_t>(columns));
  const Hdf5Id space = dataspace(sizes);
  const Hdf5Id storage = storage_of(storage_, sizes, item_bytes);
  const Hdf5Id data(
      good(H5Dcreate2(file_.get(), name.c_str(), type, space.get(), H5P_DEFAULT, storage.get(), H5P_DEFAULT)),
      H5Dclose);
  if (count > 0) good(H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

void Hdf5Image::array(const std::string& name, std::span<const double> values, int columns) {
  array(name, H5T_NATIVE_DOUBLE, values.data(), values.size(), sizeof(double), columns);
}
void Hdf5Image::array(const std::string& name, std::span<const std::int32_t> values, int columns) {
  array(name, H5T_NATIVE_INT32, values.data(), values.size(), sizeof(std::int32_t), columns);
}
void Hdf5Image::array(const std::string& name, std::span<const std::int64_t> values, int columns) {
  array(name, H5T_NATIVE_INT64, values.data(), values.size(), sizeof(std::int64_t), columns);
}
void Hdf5Image::array(const std::string& name, std::span<const std::uint8_t> values, int columns) {
  array(name, H5T_NATIVE_UINT8, values.data(), values.size(), sizeof(std::uint8_t), columns);
}

void Hdf5Image::array(const std::string& name, const ChunkedArray& values) {
  std::vector<hsize_t> sizes = {values.rows};
  if (values.columns > 1) sizes.push_back(values.columns);
  const Hdf5Id space = dataspace(sizes);
  const Hdf5Id storage = values.rows > 0 ? chunked_storage(sizes, values.chunk_rows) : timeless(H5P_DATASET_CREATE);
  const Hdf5Id data(good(H5Dcreate2(file_.get(), name.c_str(), native(values.type), space.get(), H5P_DEFAULT,
                                    storage.get(), H5P_DEFAULT)),
                    H5Dclose);
  std::array<hsize_t, 2> offset = {0, 0};
  for (const Chunk& chunk : values.chunks) {
    good(H5Dwrite_chunk(data.get(), H5P_DEFAULT, 0, offset.data(), chunk.size(), chunk.data()));
    offset[0] += values.chunk_rows;
  }
}

void Hdf5Image::link(const std::string& existing, const std::string& name) {
  good(H5Lcreate_hard(file_.get(), existing.c_str(), file_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

void Hdf5Image::text(const std::string& name, const std::string& value) {
  const Hdf5Id type = string_type(value);
  const Hdf5Id space = scalar_space();
  const Hdf5Id creation = timeless(H5P_DATASET_CREATE);
  const Hdf5Id data(
      good(H5Dcreate2(file_.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT)),
      H5Dclose);
  good(H5Dwrite(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()));
}

void Hdf5Image::attribute(const std::string& group, const std::string& name, std::span<const std::int64_t> values) {
  const hsize_t size = values.size();
  const Hdf5Id space = dataspace({&size, 1});
  const Hdf5Id attribute(good(H5Acreate_by_name(file_.get(), group.c_str(), name.c_str(), H5T_NATIVE_INT64, space.get(),
                                                H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
                         H5Aclose);
  good(H5Awrite(attribute.get(), H5T_NATIVE_INT64, values.data()));
}

void Hdf5Image::attribute(const std::string& group, const std::string& name, const std::string& value) {
  const Hdf5Id type = string_type(value);
  const Hdf5Id space = scalar_space();
  const Hdf5Id attribute(good(H5Acreate_by_name(file_.get(), group.c_str(), name.c_str(), type.get(), space.get(),
                                                H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
                         H5Aclose);
  good(H5Awrite(attribute.get(), type.get(), value.c_str()));
}

void Hdf5Image::save(const std::string& path, Durability durability) {
  good(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
  good(size < 0 ? -1 : 0);
  // The memory of the image itself: asking H5Fget_file_image for the bytes would copy them.
  void* memory = nullptr;
  good(H5Fget_vfd_handle(file_.get(), H5P_DEFAULT, &memory));
  const unsigned char* bytes = *static_cast<unsigned char**>(memory);
  OutputFile file(path);
  file.write_past_cache({reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)});
  file.commit(durability);
}

}  // namespace tessera
