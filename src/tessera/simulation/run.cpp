#include "tessera/simulation/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <optional>

#include "tessera/base/stopwatch.hpp"
#include "tessera/base/text.hpp"
#include "tessera/base/version.hpp"
#include "tessera/output/progress.hpp"
#include "tessera/output/result_folder.hpp"
#include "tessera/output/summary.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/simulation/approach.hpp"
#include "tessera/simulation/engine.hpp"
#include "tessera/simulation/recorder.hpp"
#include "tessera/simulation/signals.hpp"

namespace tessera {

namespace {

// Steps between looks at the energy, and between copies of the state to fall back to.
constexpr std::int64_t energy_interval = 20, backup_interval = 200;

/// Says when a checkpoint is due, by simulated and by wall-clock time.
class CheckpointTimer {
 public:
  CheckpointTimer(const CheckpointSpec& spec, double time) : spec_(spec), last_time_(time) {}

  bool due(double time) {
    const auto now = std::chrono::steady_clock::now();
    const bool by_time = spec_.every_time && time - last_time_ >= *spec_.every_time * (1.0 - 1e-9);
    const bool by_wall =
        spec_.every_wall && std::chrono::duration<double>(now - last_wall_).count() >= *spec_.every_wall;
    if (!by_time && !by_wall) return false;
    last_time_ = time;
    last_wall_ = now;
    return true;
  }

 private:
  CheckpointSpec spec_;
  double last_time_;
  std::chrono::steady_clock::time_point last_wall_ = std::chrono::steady_clock::now();
};

ExistingResult existing_result(const RunOptions& o) {
  if (o.resume) return ExistingResult::resume;
  return o.overwrite ? ExistingResult::overwrite : ExistingResult::refuse;
}

void write_effective_case(const Case& c, const std::string& directory) {
  std::ofstream file(effective_case_path(directory));
  file << c.effective;
  if (!file.flush()) throw RunError("cannot write " + effective_case_path(directory));
}

/// One run from set-up to summary.
class Run {
 public:
  Run(const Case& c, const RunOptions& options);
  void execute();

 private:
  void steps();
  void observe();
  void keep_going();
  void write_last_state();
  void save_checkpoint();
  void leave_traces(const std::string& message);
  MassScalingSummary mass_scaling_summary() const;
  std::vector<std::string> warnings() const;
  void summarise(const std::string& status, const std::string& message);

  const Case& case_;
  const RunOptions& options_;
  WallSeconds wall_;
  double seconds_of_first_step_ = 0.0;  // choosing it is part of the set-up's time, and accounted for apart [s]
  std::optional<Model> model_;
  std::optional<Engine> engine_;
  std::optional<Approach> approach_;
  std::optional<Recorder> recorder_;
  std::optional<Progress> progress_;
  std::optional<CheckpointTimer> checkpoint_timer_;
  std::int64_t first_step_ = 0;
  Checkpoint backup_;
  StopSignals signals_;
};

Run::Run(const Case& c, const RunOptions& options) : case_(c), options_(options) {
  const Stopwatch watch(wall_.setup);
  parallel::set_threads(options.threads);
  model_.emplace(build_model(c));
  require(model_->identities);
  engine_.emplace(*model_, c.time);
  approach_.emplace(*model_);
  seconds_of_first_step_ = engine_->step_control().seconds();
  prepare_result_folder(options.directory, existing_result(options));
  std::optional<ContinueFrom> from;
  if (options.resume) {
    engine_->restore(read_checkpoint(checkpoint_path(options.directory)));
    if (engine_->time() > c.time.end)
      throw UsageError(
          fmt::format("the results in {} have come to t = {:g} s, beyond time.end = {:g} s; nothing is left to do, and "
                      "they stay as "
                      "they are",
                      quoted(options.directory), engine_->time(), c.time.end));
    // The state itself is written again, also the first one.
    from = ContinueFrom{engine_->steps() > 0 ? engine_->time() - 0.5 * engine_->dt() : -1.0};
  }
  recorder_.emplace(c, *model_, *engine_, options.directory, from);
  write_effective_case(c, options.directory);
  first_step_ = engine_->steps();
  if (!options.quiet)
    fmt::print(stderr, "tessera: note: method.integration is {}\n",
               integration_text(integration_of(*model_), model_->system.particles()));
  const ProgressStyle style = options.quiet ? ProgressStyle::silent : progress_style(stderr);
  progress_.emplace(stderr, style, c.time.end, model_->system.particles(), engine_->time(), first_step_);
  checkpoint_timer_.emplace(c.output.checkpoint, engine_->time());
  backup_ = engine_->checkpoint();
}

void Run::execute() {
  try {
    steps();
    write_last_state();
  } catch (const Interrupted& e) {
    progress_->interrupt();
    write_checkpoint(checkpoint_path(options_.directory), engine_->checkpoint());
    summarise("interrupted", e.what());
    throw;
  } catch (const RunError& e) {
    progress_->interrupt();
    leave_traces(e.what());
    throw;
  }
  summarise("done", "");
  if (engine_->mass_scaling() && !options_.quiet) fmt::print(stderr, "{}\n", mass_scaling_text(mass_scaling_summary()));
}

void Run::write_last_state() {
  const Stopwatch watch(wall_.output);
  recorder_->write(*engine_);
  recorder_->complete();
}

/// Only after all frames up to now: resumed, the run goes on with those that come later.
void Run::save_checkpoint() {
  recorder_->complete();
  write_checkpoint(checkpoint_path(options_.directory), engine_->checkpoint());
}

void Run::steps() {
  while (!engine_->finished()) {
    keep_going();
    engine_->prepare();
    observe();
    const Stopwatch watch(wall_.steps);
    engine_->advance();
    engine_->verify_deformation();
  }
  if (case_.output.checkpoint.every_time || case_.output.checkpoint.every_wall) save_checkpoint();
  approach_->look(engine_->present_positions(), engine_->time());
  engine_->prepare();
  observe();
  progress_->finish(engine_->time(), engine_->steps(), engine_->energies().relative_error());
}

/// Checkpoints, the backup to fall back to, and the wish to stop.
void Run::keep_going() {
  const Stopwatch watch(wall_.output);
  if ((engine_->steps() - first_step_) % backup_interval == 0) {
    recorder_->complete();  // as before a checkpoint, which the backup may become
    backup_ = engine_->checkpoint();
    approach_->look(engine_->present_positions(), engine_->time());
  }
  if (const int signal = StopSignals::received(); signal != 0) {
    recorder_->complete();
    throw Interrupted(fmt::format("stopped by signal {} at step {}, t = {:g} s; go on with --resume", signal,
                                  engine_->steps(), engine_->time()));
  }
  if (checkpoint_timer_->due(engine_->time())) save_checkpoint();
}

void Run::observe() {
  const Stopwatch watch(wall_.output);
  if (engine_->steps() % energy_interval == 0 || engine_->finished()) {
    engine_->verify_energy();
    progress_->update(engine_->time(), engine_->steps(), engine_->energies().relative_error());
  }
  recorder_->write_if_due(*engine_);
}

/// The last good state and a summary. A full disk may take neither; what failed first is what the user is told last.
void Run::leave_traces(const std::string& message) {
  const auto attempt = [&](const auto& leave) {
    try {
      leave();
    } catch (const RunError& e) {
      if (e.what() != message) fmt::print(stderr, "tessera: warning: {}\n", e.what());
    }
  };
  recorder_->settle();
  engine_->restore(backup_);
  attempt([&] { write_checkpoint(checkpoint_path(options_.directory), backup_); });
  engine_->prepare();
  attempt([&] { summarise("failed", message); });
}

MassScalingSummary Run::mass_scaling_summary() const {
  const MassScaling& m = *engine_->mass_scaling();
  const auto a = static_cast<std::size_t>(m.most_affected);
  const BodyModel& body = model_->bodies[static_cast<std::size_t>(model_->body_of[a])];
  return {case_.time.mass_scaling->step,
          m.added,
          m.added_share,
          m.particles,
          body.name,
          model_->user_number[a] - body.first,
          m.largest_factor,
          m.evaluations,
          engine_->largest_kinetic_share()};
}

std::vector<std::string> Run::warnings() const {
  std::vector<std::string> list = approach_->warnings();
  if (std::string bonds = warning_of_bonds(engine_->energies()); !bonds.empty()) list.push_back(std::move(bonds));
  return list;
}

void Run::summarise(const std::string& status, const std::string& message) {
  Summary s;
  s.version = version();
  s.case_file = case_.file;
  s.status = status;
  s.message = message;
  s.particles = model_->system.particles();
  s.bonds = model_->system.tiles.bonds / 2;
  s.boundary_faces = model_->boundary_faces;
  s.steps = engine_->steps();
  s.dt = engine_->dt();
  s.time = engine_->time();
  s.wall_seconds = wall_;
  s.wall_seconds.time_step = engine_->step_control().seconds();
  s.wall_seconds.setup -= seconds_of_first_step_;
  if (wall_.steps > 0.0)
    s.particle_steps_per_second =
        static_cast<double>(s.particles) * static_cast<double>(s.steps - first_step_) / wall_.steps;
  s.peak_memory_bytes = peak_memory_bytes();
  s.energy = engine_->energies();
  s.momentum = engine_->momentum();
  const Momentum& start = engine_->initial_momentum();
  s.momentum_change = {s.momentum.linear - start.linear, s.momentum.angular - start.angular};
  if (!case_.references.empty()) {
    const Snapshot snapshot = engine_->snapshot();
    for (const ReferenceSpec& r : case_.references) s.errors[r.name] = displacement_error(snapshot, r);
  }
  s.identities = model_->identities;
  s.quality = model_->quality;
  s.step_control = {engine_->step_control().evaluations(), engine_->step_control().limit()};
  s.integration = integration_of(*model_);
  if (engine_->mass_scaling()) s.mass_scaling = mass_scaling_summary();
  s.max_force_residual = engine_->largest_force();
  s.warnings = warnings();
  for (const std::string& warning : s.warnings) fmt::print(stderr, "tessera: warning: {}\n", warning);
  write_summary(summary_path(options_.directory), s);
}

}  // namespace

void run_case(const Case& c, const RunOptions& options) { Run(c, options).execute(); }

}  // namespace tessera
