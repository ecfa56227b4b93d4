#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/output/frame_index.hpp"
#include "tessera/output/output_spec.hpp"
#include "tessera/output/quantities.hpp"
#include "tessera/output/snapshot.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// The particles of a run as a time series of files: `fields_000000.hdf` .. with the index `fields.hdf.series`,
/// `fields_000000.vtu` .. with `fields.pvd`, or `fields_000000.csv` .. with `fields.csv.series`.
class FieldSeries {
 public:
  /// Throws InputError at spec.origin for unknown quantities.
  FieldSeries(const std::string& directory, const FieldsSpec& spec);
  /// Goes on with the series of an interrupted run; frames of later times are dropped.
  FieldSeries(const std::string& directory, const FieldsSpec& spec, const ContinueFrom& from);

  /// Writes the next frame; does nothing when the last frame has the same time. Throws RunError when it cannot be
  /// written; the index then still lists the frames before.
  void write(const Snapshot& snapshot);

  const FrameIndex& index() const { return index_; }

 private:
  FieldFormat format_;
  std::vector<const Quantity*> quantities_;
  FrameIndex index_;
};

/// The cells of particles for pictures: convex parts of Voronoi cells, or tetrahedra whose corners are particles.
/// Particles have their numbers in the snapshot.
using CellGeometry = std::variant<std::vector<Polyhedron>, std::vector<std::array<Index, 4>>>;

/// The cells of a run as a time series `cells_000000.vtu` .. with the index `cells.pvd`. Polyhedra move with the
/// homogeneous motion of their particle, x_a + F_a (X - X_a), and carry its quantities as cell data; tetrahedra have
/// the particles as points, with point data. Quantities as in FieldSeries.
class CellSeries {
 public:
  CellSeries(const std::string& directory, const FieldsSpec& spec, CellGeometry cells);
  CellSeries(const std::string& directory, const FieldsSpec& spec, CellGeometry cells, const ContinueFrom& from);

  /// As FieldSeries::write().
  void write(const Snapshot& snapshot);

  const FrameIndex& index() const { return index_; }

 private:
  CellGeometry cells_;
  std::vector<const Quantity*> quantities_;
  FrameIndex index_;
};

}  // namespace tessera
