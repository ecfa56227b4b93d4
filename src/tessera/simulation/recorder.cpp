#include "tessera/simulation/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/output/result_folder.hpp"

namespace tessera {

namespace {

Selection compile(const SelectionSpec& where, const Surface& surface) {
  return Selection(where, surface.known_names, surface.lower, surface.upper);
}

/// Internal numbers of the particles of a body that `where` takes (all without one), as user numbers.
std::vector<Index> candidates(const ProbeSpec& spec, const Model& model) {
  const BodyModel& body = model.body(spec.body);
  std::vector<std::vector<std::string>> names(static_cast<std::size_t>(body.last - body.first));
  for (const SurfacePiece& piece : body.surface.pieces)
    for (Index a : piece.vertices) {
      const auto more = body.surface.names_of(piece);
      auto& list = names[static_cast<std::size_t>(a)];
      list.insert(list.end(), more.begin(), more.end());
    }
  std::optional<Selection> where;
  if (spec.where) where.emplace(compile(*spec.where, body.surface));
  std::vector<Index> taken;
  for (Index a = body.first; a < body.last; ++a) {
    const auto& own = names[static_cast<std::size_t>(a - body.first)];
    if (!where || where->takes({model.system.d.X[static_cast<std::size_t>(a)], own}))
      taken.push_back(model.user_number[static_cast<std::size_t>(a)]);
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

std::vector<Column> ledger_columns() {
  return {{"t", "s"},          {"kinetic", "J"},      {"internal", "J"}, {"contact", "J"}, {"external_work", "J"},
          {"dissipated", "J"}, {"energy_error", "-"}, {"px", "kg m/s"},  {"py", "kg m/s"}, {"pz", "kg m/s"},
          {"lx", "kg m2/s"},   {"ly", "kg m2/s"},     {"lz", "kg m2/s"}, {"dt", "s"}};
}

/// Is a multiple of `every` reached? Allows for the rounding of a time that many steps add up to.
std::int64_t multiples(double time, double every) {
  return static_cast<std::int64_t>(std::floor(time / every * (1.0 + 1e-12) + 1e-9));
}

template <class Series, class... Arguments>
Series open(const std::optional<ContinueFrom>& from, Arguments&&... arguments) {
  return from ? Series(std::forward<Arguments>(arguments)..., *from) : Series(std::forward<Arguments>(arguments)...);
}

}  // namespace

ReactionProbe bind_reaction(const ProbeSpec& spec, const Model& model, const Engine& engine) {
  const BodyModel& body = model.body(spec.body);
  std::optional<Selection> where;
  if (spec.where) where.emplace(compile(*spec.where, body.surface));
  ReactionProbe probe;
  const auto take = [&](std::size_t point, const SurfacePiece& piece, const Vec3& X) {
    if (!where || where->takes({X, body.surface.names_of(piece)})) probe.points.push_back(point);
  };
  for (std::size_t i = 0; i < body.node_piece.size(); ++i) {
    const SurfacePiece& piece = body.surface.pieces[static_cast<std::size_t>(body.node_piece[i])];
    take(static_cast<std::size_t>(body.first_node) + i, piece, piece.centroid);
  }
  for (Index i = body.first_constraint; i < body.last_constraint; ++i) {
    const Index a = model.system.d.constraints[static_cast<std::size_t>(i)].particle;
    for (const SurfacePiece& piece : body.surface.pieces) {
      if (std::find(piece.vertices.begin(), piece.vertices.end(), a - body.first) == piece.vertices.end()) continue;
      const std::size_t before = probe.points.size();
      take(static_cast<std::size_t>(i), piece, model.system.d.X[static_cast<std::size_t>(a)]);
      if (probe.points.size() > before) break;
    }
  }
  if (probe.points.empty() || engine.reactions().empty())
    throw InputError(spec.origin,
                     fmt::format("takes nothing of body \"{}\" whose motion is prescribed, so there is no reaction to "
                                 "measure; select what a [[boundary]] entry with a displacement, velocity or "
                                 "condition selects",
                                 body.name));
  return probe;
}

HistoryRows::HistoryRows(const Case& c, const Model& model, const Engine& engine, const Snapshot& first)
    : columns_(ledger_columns()) {
  for (const ProbeSpec& spec : c.probes) {
    Probe probe;
    if (spec.kind == ProbeKind::reaction) {
      probe.bound.spec = spec;
      probe.reaction = bind_reaction(spec, model, engine);
    } else {
      probe.bound = bind_probe(spec, first, candidates(spec, model));
      needs_snapshot_ = true;
    }
    const std::vector<Column> columns = probe_columns(spec);
    columns_.insert(columns_.end(), columns.begin(), columns.end());
    probes_.push_back(std::move(probe));
  }
}

std::vector<double> HistoryRows::row(const Engine& engine) const {
  const EnergyLedger e = engine.energies();
  const Momentum m = engine.momentum();
  std::vector<double> row{engine.time(), e.kinetic,          e.internal,  e.contact,  e.external_work,
                          e.dissipated,  e.relative_error(), m.linear.x,  m.linear.y, m.linear.z,
                          m.angular.x,   m.angular.y,        m.angular.z, engine.dt()};
  const Snapshot snapshot = needs_snapshot_ ? engine.snapshot() : Snapshot{};
  for (const Probe& probe : probes_) {
    if (probe.bound.spec.kind == ProbeKind::reaction) {
      Vec3 force, torque;
      for (std::size_t i : probe.reaction.points) {
        const Vec3& reaction = engine.reactions()[i];
        force += reaction;
        torque += cross(engine.reaction_point(i) - probe.bound.spec.about, reaction);
      }
      row.insert(row.end(), {force.x, force.y, force.z, torque.x, torque.y, torque.z});
    } else {
      const std::vector<double> values = probe_values(probe.bound, snapshot);
      row.insert(row.end(), values.begin(), values.end());
    }
  }
  return row;
}

Recorder::Recorder(const Case& c, const Model& model, const Engine& engine, const std::string& directory,
                   const std::optional<ContinueFrom>& from)
    : rows_(c, model, engine, engine.snapshot()),
      history_(open<History>(from, history_path(directory), rows_.columns())),
      fields_(open<FieldSeries>(from, directory, c.output.fields)),
      fields_every_(c.output.fields.every),
      history_every_(c.output.history.every.value_or(0.01 * c.time.end)) {
  if (model.cells) cells_.emplace(open<CellSeries>(from, directory, c.output.fields, *model.cells));
  if (!from || engine.steps() == 0) return;
  // What the step that led here reached is still to be written, even when it was due long before its end.
  const double before = engine.time() - engine.dt();
  if (fields_every_) next_frame_ = multiples(before, *fields_every_) + 1;
  next_row_ = multiples(before, history_every_) + 1;
}

void Recorder::write_if_due(const Engine& engine) {
  background_.check();
  const double t = engine.time();
  if (history_every_ <= 0.0 || multiples(t, history_every_) >= next_row_) {
    history_.append(rows_.row(engine));
    if (history_every_ > 0.0) next_row_ = multiples(t, history_every_) + 1;
  }
  if (fields_every_ ? multiples(t, *fields_every_) >= next_frame_ : !fields_.last_time()) {
    write_fields(engine);
    if (fields_every_) next_frame_ = multiples(t, *fields_every_) + 1;
  }
}

void Recorder::write(const Engine& engine) {
  history_.append(rows_.row(engine));
  write_fields(engine);
}

void Recorder::complete() { background_.wait(); }

void Recorder::write_fields(const Engine& engine) {
  if (fields_.last_time() == engine.time()) return;
  background_.wait();
  const SnapshotSource source = engine.snapshots();
  std::vector<WriteJob> jobs = {fields_.take(source)};
  if (cells_) jobs.push_back(cells_->take(std::make_shared<const Snapshot>(source.part(0, source.particles))));
  background_.start([jobs = std::move(jobs)] {
    for (const WriteJob& job : jobs) job();
  });
}

}  // namespace tessera
