#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/output/fields.hpp"
#include "tessera/output/history.hpp"
#include "tessera/output/probes.hpp"
#include "tessera/parallel/background.hpp"
#include "tessera/simulation/engine.hpp"

namespace tessera {

/// A reaction probe: the boundary nodes or constrained particles whose forces it adds up.
struct ReactionProbe {
  std::vector<std::size_t> points;  // indices into Engine::reactions()
};

/// Ties reaction probes to what they read. Throws InputError when `where` takes nothing that is prescribed.
ReactionProbe bind_reaction(const ProbeSpec& spec, const Model& model, const Engine& engine);

/// Columns of history.csv and a row of values at the present time.
class HistoryRows {
 public:
  HistoryRows(const Case& c, const Model& model, const Engine& engine, const Snapshot& first);

  const std::vector<Column>& columns() const { return columns_; }
  std::vector<double> row(const Engine& engine) const;

 private:
  struct Probe {
    BoundProbe bound;
    ReactionProbe reaction;
  };
  std::vector<Column> columns_;
  std::vector<Probe> probes_;
  bool needs_snapshot_ = false;
};

/// Writes fields, cells and history when they are due. Frames are taken at once and written in the background, one at a
/// time: a run waits for the frame before when it wants to take the next, so that frames never pile up in memory.
class Recorder {
 public:
  Recorder(const Case& c, const Model& model, const Engine& engine, const std::string& directory,
           const std::optional<ContinueFrom>& from);

  /// Writes what is due at the engine's present time, on which prepare() was called. Throws RunError when that fails,
  /// or when a frame taken before could not be written.
  void write_if_due(const Engine& engine);
  /// Writes a frame and a row whether due or not (equal times are written once).
  void write(const Engine& engine);
  /// Returns when every frame taken so far is on the disk and in the index; throws RunError when one is not. To be
  /// called before a checkpoint: a resumed run does not write what came before it.
  void complete();
  /// As complete(), for a run that has failed already: a frame that cannot be written is left out.
  void settle() noexcept { background_.settle(); }

 private:
  void write_fields(const Engine& engine);

  HistoryRows rows_;
  History history_;
  FieldSeries fields_;
  std::optional<CellSeries> cells_;
  std::optional<double> fields_every_;
  double history_every_;
  std::int64_t next_frame_ = 0, next_row_ = 0;  // number of the next multiple of `every`
  parallel::Background background_;             // last: what it does uses the members above
};

}  // namespace tessera
