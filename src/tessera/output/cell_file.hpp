#pragma once

#include <array>
#include <string>
#include <vector>

#include "tessera/output/field_file.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// One frame of polyhedral cells as VTU. Points move with x_a + F_a (X - X_a), so neighbouring cells separate where
/// their deformation gradients differ; quantities are cell data. Throws RunError when the file cannot be written.
void write_cells(const std::string& path, const Snapshot& snapshot, QuantityList quantities,
                 const std::vector<Polyhedron>& cells);

/// One frame of tetrahedra as VTU: the points are all particles, quantities are point data.
void write_cells(const std::string& path, const Snapshot& snapshot, QuantityList quantities,
                 const std::vector<std::array<Index, 4>>& tetrahedra);

}  // namespace tessera
