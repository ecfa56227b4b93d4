#pragma once

#include <span>
#include <string>

#include "tessera/output/quantities.hpp"
#include "tessera/output/snapshot.hpp"
#include "tessera/output/vtu_file.hpp"

namespace tessera {

using QuantityList = std::span<const Quantity* const>;

/// One frame of particles as VTU: vertices at the current positions. Throws RunError, as all writers here, when the
/// file cannot be written.
void write_field_vtu(const std::string& path, const Snapshot& snapshot, QuantityList quantities);

/// One frame of particles as a table, a row per particle: columns `displacement_x[m]`, `J[-]` .., 17 digits.
void write_field_csv(const std::string& path, const Snapshot& snapshot, QuantityList quantities);

/// Adds `values` (components of one item after another) to the current section; integer quantities become Int32.
void write_quantity(VtuFile& file, const Quantity& quantity, std::span<const double> values);

}  // namespace tessera
