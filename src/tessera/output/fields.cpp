#include "tessera/output/fields.hpp"

#include "tessera/output/cell_file.hpp"
#include "tessera/output/field_file.hpp"

namespace tessera {

namespace {

std::string extension(FieldFormat format) {
  switch (format) {
    case FieldFormat::vtu:
      return ".vtu";
    case FieldFormat::csv:
      return ".csv";
    case FieldFormat::vtkhdf:
      break;
  }
  return ".hdf";  // ParaView before 5.12 has no reader for names in .vtkhdf
}

IndexKind index_kind(FieldFormat format) { return format == FieldFormat::vtu ? IndexKind::pvd : IndexKind::series; }

std::shared_ptr<const Snapshot> whole(const SnapshotSource& source) {
  return std::make_shared<const Snapshot>(source.part(0, source.particles));
}

}  // namespace

FieldSeries::FieldSeries(const std::string& directory, const FieldsSpec& spec)
    : format_(spec.format),
      quantities_(field_quantities(spec.quantities, spec.origin)),
      index_(directory, "fields", extension(format_), index_kind(format_)),
      frames_(quantities_, spec.precision) {}

FieldSeries::FieldSeries(const std::string& directory, const FieldsSpec& spec, const ContinueFrom& from)
    : format_(spec.format),
      quantities_(field_quantities(spec.quantities, spec.origin)),
      index_(directory, "fields", extension(format_), index_kind(format_), from),
      last_time_(index_.last_time()),
      frames_(quantities_, spec.precision) {}

WriteJob FieldSeries::take(const SnapshotSource& source) {
  last_time_ = source.time;
  const auto job = [this, time = source.time](auto write) {
    return [this, time, write] {
      write(index_.next_path());
      index_.add(time);
    };
  };
  switch (format_) {
    case FieldFormat::vtu:
      return job([this, s = whole(source)](const std::string& path) { write_field_vtu(path, *s, quantities_); });
    case FieldFormat::csv:
      return job([this, s = whole(source)](const std::string& path) { write_field_csv(path, *s, quantities_); });
    case FieldFormat::vtkhdf:
      break;
  }
  return job([frame = std::make_shared<const VtkhdfFrame>(frames_.take(source))](const std::string& path) {
    write_field_vtkhdf(path, *frame);
  });
}

void FieldSeries::write(const Snapshot& snapshot) {
  if (index_.last_time() == snapshot.time) return;
  take(parts_of(snapshot))();
}

CellSeries::CellSeries(const std::string& directory, const FieldsSpec& spec, CellGeometry cells)
    : cells_(std::move(cells)),
      quantities_(field_quantities(spec.quantities, spec.origin)),
      index_(directory, "cells", ".vtu", IndexKind::pvd) {}

CellSeries::CellSeries(const std::string& directory, const FieldsSpec& spec, CellGeometry cells,
                       const ContinueFrom& from)
    : cells_(std::move(cells)),
      quantities_(field_quantities(spec.quantities, spec.origin)),
      index_(directory, "cells", ".vtu", IndexKind::pvd, from) {}

WriteJob CellSeries::take(std::shared_ptr<const Snapshot> snapshot) {
  return [this, snapshot = std::move(snapshot)] { write(*snapshot); };
}

void CellSeries::write(const Snapshot& snapshot) {
  if (index_.last_time() == snapshot.time) return;
  std::visit([&](const auto& cells) { write_cells(index_.next_path(), snapshot, quantities_, cells); }, cells_);
  index_.add(snapshot.time);
}

}  // namespace tessera
