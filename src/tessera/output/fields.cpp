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

void write_frame(FieldFormat format, const std::string& path, const Snapshot& snapshot, QuantityList quantities) {
  switch (format) {
    case FieldFormat::vtkhdf:
      return write_field_vtkhdf(path, snapshot, quantities);
    case FieldFormat::vtu:
      return write_field_vtu(path, snapshot, quantities);
    case FieldFormat::csv:
      return write_field_csv(path, snapshot, quantities);
  }
}

}  // namespace

FieldSeries::FieldSeries(const std::string& directory, const FieldsSpec& spec)
    : format_(spec.format),
      quantities_(field_quantities(spec.quantities, spec.origin)),
      index_(directory, "fields", extension(format_), index_kind(format_)) {}

FieldSeries::FieldSeries(const std::string& directory, const FieldsSpec& spec, const ContinueFrom& from)
    : format_(spec.format),
      quantities_(field_quantities(spec.quantities, spec.origin)),
      index_(directory, "fields", extension(format_), index_kind(format_), from) {}

void FieldSeries::write(const Snapshot& snapshot) {
  if (index_.last_time() == snapshot.time) return;
  write_frame(format_, index_.next_path(), snapshot, quantities_);
  index_.add(snapshot.time);
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

void CellSeries::write(const Snapshot& snapshot) {
  if (index_.last_time() == snapshot.time) return;
  std::visit([&](const auto& cells) { write_cells(index_.next_path(), snapshot, quantities_, cells); }, cells_);
  index_.add(snapshot.time);
}

}  // namespace tessera
