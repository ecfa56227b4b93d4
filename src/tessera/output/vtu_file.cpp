#include "tessera/output/vtu_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "tessera/base/error.hpp"

namespace tessera {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

constexpr std::size_t block_bytes = std::size_t{1} << 20;
constexpr int zlib_level = 1;  // higher levels save little on doubles and take several times longer

template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string deflated(std::string_view block) {
  uLongf size = compressBound(block.size());
  std::string result(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                               reinterpret_cast<const Bytef*>(block.data()), block.size(), zlib_level);
  if (status != Z_OK) throw RunError("zlib could not compress a field: out of memory");
  result.resize(size);
  return result;
}

}  // namespace

std::string encode_vtk(std::string_view bytes) {
  const std::size_t whole = bytes.size() / block_bytes;
  const std::size_t rest = bytes.size() % block_bytes;
  std::vector<std::uint64_t> header = {whole + (rest > 0 ? 1 : 0), block_bytes, rest};
  std::string blocks;
  for (std::size_t begin = 0; begin < bytes.size(); begin += block_bytes) {
    const std::string block = deflated(bytes.substr(begin, block_bytes));
    header.push_back(block.size());
    blocks += block;
  }
  return base64(bytes_of(std::span<const std::uint64_t>(header))) + base64(blocks);
}

VtuFile::VtuFile(const std::string& path, double time, std::size_t points, std::size_t cells) : file_(path) {
  file_.write(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n");
  begin("FieldData");
  file_.write(
      fmt::format("<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
                  "</DataArray>\n",
                  time));
  end("FieldData");
  file_.write(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, cells));
}

void VtuFile::begin(std::string_view section) { file_.write(fmt::format("<{}>\n", section)); }
void VtuFile::end(std::string_view section) { file_.write(fmt::format("</{}>\n", section)); }

void VtuFile::array(std::string_view name, std::string_view type, int components, std::string_view bytes) {
  file_.write(fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n", type,
                          name, components));
  file_.write(encode_vtk(bytes));
  file_.write("\n</DataArray>\n");
}

void VtuFile::array(std::string_view name, int components, std::span<const double> values) {
  array(name, "Float64", components, bytes_of(values));
}
void VtuFile::array(std::string_view name, int components, std::span<const std::int32_t> values) {
  array(name, "Int32", components, bytes_of(values));
}
void VtuFile::array(std::string_view name, int components, std::span<const std::int64_t> values) {
  array(name, "Int64", components, bytes_of(values));
}
void VtuFile::array(std::string_view name, int components, std::span<const std::uint8_t> values) {
  array(name, "UInt8", components, bytes_of(values));
}

void VtuFile::finish() {
  file_.write("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  file_.commit(Durability::process);
}

}  // namespace tessera
