#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tessera/tessellation/surface_cutter.hpp"

namespace tessera {

/// Finds new owners for the parts of cells that the surface cuts off from their particles.
class SplitCells {
 public:
  /// `cells` holds, per particle, its cell if that falls into parts, else nothing. It must outlive this. Throws
  /// GeometryError for parts of more than half a cell and for those that no face connects to a particle.
  SplitCells(Generators points, std::span<const std::unique_ptr<CutCell>> cells);

  /// The particle that the part of a cell belongs to now.
  Index owner(Index cell, Index part) const;
  /// The particle behind a face of a split cell.
  Index owner_behind(Index cell, const CutFace& face) const;

 private:
  Index part_behind(Index cell, const CutFace& face) const;
  void check_sizes() const;
  bool adopt();
  void keep_flat_parts();
  void check_adopted() const;
  [[noreturn]] void report(Index cell, Index part, const char* text) const;

  Generators points_;
  std::span<const std::unique_ptr<CutCell>> cells_;
  std::vector<std::vector<Index>> owner_;  // per cell, per part; -1 while unknown
};

}  // namespace tessera
