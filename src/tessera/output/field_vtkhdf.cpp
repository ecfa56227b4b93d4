#include "tessera/output/field_vtkhdf.hpp"

#include <algorithm>
#include <array>

#include "tessera/output/byte_planes.hpp"
#include "tessera/output/hdf5_image.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

// Rows of a chunk: few enough that they stay in a core's cache, enough for a table of Huffman codes.
constexpr std::size_t block_rows = 8192;
// Rows of a snapshot: the numbers that quantities are computed from stay in the cache, too, and in memory that the
// process need not ask for anew.
constexpr std::size_t snapshot_rows = 1024;

ChunkedArray shaped(ElementType type, std::size_t rows, std::size_t columns) {
  ChunkedArray array;
  array.type = type;
  array.rows = rows;
  array.columns = columns;
  array.chunk_rows = std::min(rows, block_rows);
  array.chunks.resize((rows + block_rows - 1) / block_rows);
  return array;
}

void compress(PlaneDeflater& deflater, const ChunkedArray& array, std::span<const unsigned char> planes, Chunk& chunk) {
  const bool floating = array.type == ElementType::float32 || array.type == ElementType::float64;
  floating ? PlaneDeflater::numbers(planes, width_of(array.type), chunk) : deflater.integers(planes, chunk);
}

/// The same stress counts several times.
bool comes_from_cauchy_stress(const Quantity& quantity) {
  return quantity.name == "cauchy_stress" || quantity.name == "von_mises" || quantity.name == "pressure";
}

VtkhdfFrame::Array named(const std::string& name, ChunkedArray&& array) {
  return {name, std::make_shared<const ChunkedArray>(std::move(array))};
}

}  // namespace

VtkhdfFrames::VtkhdfFrames(std::span<const Quantity* const> quantities, FieldPrecision precision)
    : precision_(precision),
      workspaces_(std::make_unique<parallel::Workspaces<Workspace>>([] { return std::make_unique<Workspace>(); })) {
  const Quantity* position = &find_quantity("position", {});
  changing_.push_back({position, "/VTKHDF/Points", ElementType::float64});
  for (const Quantity* quantity : quantities) {
    std::string name = "/VTKHDF/PointData/" + std::string(quantity->name);
    if (quantity == position)
      copies_of_points_.push_back(std::move(name));
    else
      (quantity->variation == Variation::constant ? constant_ : changing_)
          .push_back({quantity, std::move(name), type_of(*quantity)});
  }
}

ElementType VtkhdfFrames::type_of(const Quantity& quantity) const {
  if (quantity.is_integer()) return ElementType::int32;
  const bool full = precision_ == FieldPrecision::full || quantity.exactness == Exactness::full;
  return full ? ElementType::float64 : ElementType::float32;
}

VtkhdfFrame VtkhdfFrames::take(const SnapshotSource& source) {
  const auto n = static_cast<std::size_t>(source.particles);
  if (constants_.empty()) {
    Arrays arrays;
    constants_ = compressed(source, constant_, arrays);
    constants_.push_back(sequence("/VTKHDF/Offsets", n + 1));
    constants_.push_back(sequence("/VTKHDF/Connectivity", n));
    constants_.push_back(vertex_types(n));
  }
  VtkhdfFrame frame{source.time, n, compressed(source, changing_, memory_), copies_of_points_, image_};
  frame.arrays.insert(frame.arrays.end(), constants_.begin(), constants_.end());
  return frame;
}

std::vector<VtkhdfFrame::Array> VtkhdfFrames::compressed(const SnapshotSource& source, std::span<const Column> columns,
                                                         Arrays& arrays) {
  const auto n = static_cast<std::size_t>(source.particles);
  arrays.resize(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (!arrays[c] || arrays[c]->rows != n || arrays[c].use_count() > 1)  // else the frame before is written
      arrays[c] = std::make_shared<ChunkedArray>(
          shaped(columns[c].type, n, static_cast<std::size_t>(columns[c].quantity->components())));
  parallel::for_tasks(static_cast<std::int64_t>((n + block_rows - 1) / block_rows), [&](std::int64_t block) {
    compress_block(source, columns, static_cast<std::size_t>(block), arrays);
  });
  std::vector<VtkhdfFrame::Array> result;
  for (std::size_t c = 0; c < columns.size(); ++c) result.push_back({columns[c].name, arrays[c]});
  return result;
}

void VtkhdfFrames::compress_block(const SnapshotSource& source, std::span<const Column> columns, std::size_t block,
                                  const Arrays& arrays) {
  const parallel::Workspaces<Workspace>::Lease work(*workspaces_);
  const std::size_t begin = block * block_rows;
  const std::size_t end = std::min(begin + block_rows, static_cast<std::size_t>(source.particles));
  work->planes.resize(std::max(work->planes.size(), columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    work->planes[c].resize(arrays[c]->chunk_bytes());
    if (end - begin < arrays[c]->chunk_rows) std::fill(work->planes[c].begin(), work->planes[c].end(), 0);
  }
  const bool stressed = std::any_of(columns.begin(), columns.end(),
                                    [](const Column& column) { return comes_from_cauchy_stress(*column.quantity); });
  for (std::size_t row = begin; row < end; row += snapshot_rows) {
    source.take(static_cast<Index>(row), static_cast<Index>(std::min(row + snapshot_rows, end)), work->part);
    if (stressed) keep_cauchy_stresses(work->part);
    for (std::size_t c = 0; c < columns.size(); ++c)
      write_planes(evaluate(*columns[c].quantity, work->part, work->values), arrays[c]->type,
                   work->planes[c].data() + (row - begin) * arrays[c]->columns, arrays[c]->plane_bytes());
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
    compress(work->deflater, *arrays[c], work->planes[c], arrays[c]->chunks[block]);
}

VtkhdfFrame::Array VtkhdfFrames::sequence(const std::string& name, std::size_t size) {
  ChunkedArray array = shaped(ElementType::int64, size, 1);
  parallel::for_tasks(static_cast<std::int64_t>(array.chunks.size()), [&](std::int64_t block) {
    const auto b = static_cast<std::size_t>(block);
    const parallel::Workspaces<Workspace>::Lease work(*workspaces_);
    work->values.clear();
    for (std::size_t i = b * block_rows; i < std::min((b + 1) * block_rows, size); ++i)
      work->values.push_back(static_cast<double>(i));
    std::vector<unsigned char> planes(array.chunk_bytes());
    write_planes(std::as_bytes(std::span(work->values)), array.type, planes.data(), array.plane_bytes());
    compress(work->deflater, array, planes, array.chunks[b]);
  });
  return named(name, std::move(array));
}

VtkhdfFrame::Array VtkhdfFrames::vertex_types(std::size_t size) {
  constexpr unsigned char vtk_vertex = 1;
  ChunkedArray array = shaped(ElementType::uint8, size, 1);
  const parallel::Workspaces<Workspace>::Lease work(*workspaces_);
  const std::vector<unsigned char> types(array.chunk_bytes(), vtk_vertex);
  for (Chunk& chunk : array.chunks) compress(work->deflater, array, types, chunk);
  return named("/VTKHDF/Types", std::move(array));
}

void write_field_vtkhdf(const std::string& path, const VtkhdfFrame& frame) {
  constexpr std::array<std::int64_t, 2> version = {1, 0};
  Hdf5Image file(Hdf5Storage::compressed, *frame.image);
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Version", version);
  file.attribute("/VTKHDF", "Type", "UnstructuredGrid");
  file.group("/VTKHDF/PointData");
  file.group("/VTKHDF/FieldData");
  file.array("/VTKHDF/FieldData/TimeValue", std::array<double, 1>{frame.time});
  const std::array<std::int64_t, 1> count = {static_cast<std::int64_t>(frame.particles)};
  for (const char* name : {"/VTKHDF/NumberOfPoints", "/VTKHDF/NumberOfCells", "/VTKHDF/NumberOfConnectivityIds"})
    file.array(name, count);
  for (const VtkhdfFrame::Array& array : frame.arrays) file.array(array.name, *array.values);
  for (const std::string& name : frame.copies_of_points) file.link("/VTKHDF/Points", name);
  file.save(path, Durability::process);
}

}  // namespace tessera
