#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tessera/output/output_file.hpp"

namespace tessera {

/// `bytes` as VTK's inline binary data: zlib blocks, the header of their sizes (64 bit) and the blocks each in base64.
std::string encode_vtk(std::string_view bytes);

/// Writes a VTK unstructured grid (.vtu) array by array. Data are inline base64 with zlib: raw appended data, though
/// shorter, are refused by the XML parser of widespread ParaView builds.
class VtuFile {
 public:
  /// Begins the file of one frame. Throws RunError, as every function here does, when the file cannot be written.
  VtuFile(const std::string& path, double time, std::size_t points, std::size_t cells);

  /// Sections in VTK's order: points(), cells() .. end, point data, cell data.
  void begin(std::string_view section);
  void end(std::string_view section);

  void array(std::string_view name, int components, std::span<const double> values);
  void array(std::string_view name, int components, std::span<const std::int32_t> values);
  void array(std::string_view name, int components, std::span<const std::int64_t> values);
  void array(std::string_view name, int components, std::span<const std::uint8_t> values);

  void finish();

 private:
  void array(std::string_view name, std::string_view type, int components, std::string_view bytes);

  OutputFile file_;
};

}  // namespace tessera
