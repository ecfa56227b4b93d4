#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tessera/output/chunked_array.hpp"
#include "tessera/output/field_file.hpp"
#include "tessera/output/image_memory.hpp"
#include "tessera/output/output_spec.hpp"
#include "tessera/output/plane_deflater.hpp"
#include "tessera/parallel/workspaces.hpp"

namespace tessera {

/// One frame of particles, compressed and ready to be written: what a run keeps of it while it goes on. About 240 bytes
/// a particle with all quantities.
struct VtkhdfFrame {
  struct Array {
    std::string name;  // path in the file
    std::shared_ptr<const ChunkedArray> values;
  };
  double time = 0.0;  // [s]
  std::size_t particles = 0;
  std::vector<Array> arrays;
  std::vector<std::string> copies_of_points;  // names under which the positions appear as well
  std::shared_ptr<ImageMemory> image;         // where the file is put together, one frame at a time
};

/// Takes frames. Quantities are computed and compressed in blocks of particles, in parallel; what cannot change during
/// a run is compressed once. The memory of a frame that nobody needs any longer is used for the next.
class VtkhdfFrames {
 public:
  VtkhdfFrames(std::span<const Quantity* const> quantities, FieldPrecision precision);

  VtkhdfFrame take(const SnapshotSource& source);

 private:
  struct Column {
    const Quantity* quantity;
    std::string name;  // path in the file
    ElementType type;
  };
  struct Workspace {
    PlaneDeflater deflater;
    Snapshot part;
    std::vector<double> values;
    std::vector<RawField<unsigned char>> planes;  // of a chunk, for each column
  };

  ElementType type_of(const Quantity& quantity) const;
  using Arrays = std::vector<std::shared_ptr<ChunkedArray>>;
  std::vector<VtkhdfFrame::Array> compressed(const SnapshotSource& source, std::span<const Column> columns,
                                             Arrays& arrays);
  void compress_block(const SnapshotSource& source, std::span<const Column> columns, std::size_t block,
                      const Arrays& arrays);
  VtkhdfFrame::Array sequence(const std::string& name, std::size_t size);
  VtkhdfFrame::Array vertex_types(std::size_t size);

  FieldPrecision precision_;
  std::vector<Column> changing_, constant_;
  std::vector<std::string> copies_of_points_;
  std::vector<VtkhdfFrame::Array> constants_;  // compressed with the first frame
  Arrays memory_;                              // of the last frame
  std::shared_ptr<ImageMemory> image_ = std::make_shared<ImageMemory>();
  std::unique_ptr<parallel::Workspaces<Workspace>> workspaces_;
};

/// Writes a frame as VTKHDF 1.0: an unstructured grid of vertices at the current positions, compressed by shuffle and
/// deflate. Throws RunError when the file cannot be written.
/// (Version 1.0 and one file a frame because ParaView before 5.12 reads neither times nor poly data from newer ones.)
void write_field_vtkhdf(const std::string& path, const VtkhdfFrame& frame);

}  // namespace tessera
