#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/output/field_vtkhdf.hpp"
#include "tessera/output/frame_index.hpp"
#include "tessera/output/output_spec.hpp"
#include "tessera/output/quantities.hpp"
#include "tessera/output/snapshot.hpp"
#include "tessera/tessellation/cells.hpp"

namespace tessera {

/// What is left to do for a frame that was taken.
using WriteJob = std::function<void()>;

/// The particles of a run as a time series of files: `fields_000000.hdf` .. with the index `fields.hdf.series`,
/// `fields_000000.vtu` .. with `fields.pvd`, or `fields_000000.csv` .. with `fields.csv.series`.
class FieldSeries {
 public:
  /// Throws InputError at spec.origin for unknown quantities.
  FieldSeries(const std::string& directory, const FieldsSpec& spec);
  /// Goes on with the series of an interrupted run; frames of later times are dropped.
  FieldSeries(const std::string& directory, const FieldsSpec& spec, const ContinueFrom& from);

  /// Takes the next frame and returns what is left to do: the job writes it and then names it in the index. Jobs may
  /// run on another thread, in the order in which they were made and one after the other; `source` is needed no longer.
  /// A job throws RunError when the frame cannot be written; the index then still lists the frames before.
  WriteJob take(const SnapshotSource& source);
  /// Writes the next frame at once; does nothing when the last frame has the same time.
  void write(const Snapshot& snapshot);

  /// Time of the last frame that was taken [s].
  std::optional<double> last_time() const { return last_time_; }
  /// What is written; to be looked at when no job is under way.
  const FrameIndex& index() const { return index_; }

 private:
  FieldFormat format_;
  std::vector<const Quantity*> quantities_;
  FrameIndex index_;
  std::optional<double> last_time_;
  VtkhdfFrames frames_;
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

  /// As FieldSeries::take() and write().
  WriteJob take(std::shared_ptr<const Snapshot> snapshot);
  void write(const Snapshot& snapshot);

  const FrameIndex& index() const { return index_; }

 private:
  CellGeometry cells_;
  std::vector<const Quantity*> quantities_;
  FrameIndex index_;
};

}  // namespace tessera
