#pragma once

#include <span>
#include <string>

#include "tessera/output/quantities.hpp"
#include "tessera/output/snapshot.hpp"
#include "tessera/output/vtu_file.hpp"

namespace tessera {

using QuantityList = std::span<const Quantity* const>;

/// One frame of particles as VTKHDF 1.0: an unstructured grid of vertices at the current positions, point data
/// compressed by shuffle and gzip. Throws RunError, as all writers here, when the file cannot be written.
/// (Version 1.0 and one file a frame because ParaView before 5.12 reads neither times nor poly data from newer ones.)
void write_field_vtkhdf(const std::string& path, const Snapshot& snapshot, QuantityList quantities);

/// One frame of particles as VTU: vertices at the current positions.
void write_field_vtu(const std::string& path, const Snapshot& snapshot, QuantityList quantities);

/// One frame of particles as a table, a row per particle: columns `displacement_x[m]`, `J[-]` .., 17 digits.
void write_field_csv(const std::string& path, const Snapshot& snapshot, QuantityList quantities);

/// Adds `values` (components of one item after another) to the current section; integer quantities become Int32.
void write_quantity(VtuFile& file, const Quantity& quantity, std::span<const double> values);

}  // namespace tessera
