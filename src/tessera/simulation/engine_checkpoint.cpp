#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tessera/simulation/engine.hpp"

namespace tessera {

namespace {

std::vector<double> flat(const Double4* v, std::size_t n) {
  std::vector<double> values;
  values.reserve(3 * n);
  for (std::size_t i = 0; i < n; ++i) values.insert(values.end(), {v[i][0], v[i][1], v[i][2]});
  return values;
}

std::vector<double> flat(const std::vector<Vec3>& v) {
  std::vector<double> values;
  values.reserve(3 * v.size());
  for (const Vec3& p : v) values.insert(values.end(), {p.x, p.y, p.z});
  return values;
}

std::vector<double> flat(const Field<Tensor>& tensors) {
  std::vector<double> values;
  values.reserve(9 * tensors.size());
  for (const Tensor& t : tensors) {
    const Mat3 m = to_mat3(t);
    values.insert(values.end(), m.m.begin(), m.m.end());
  }
  return values;
}

Field<Double4> vectors(const std::vector<double>& values) {
  Field<Double4> v;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    v.push_back(Double4{values[i], values[i + 1], values[i + 2], 0.0});
  return v;
}

std::vector<Vec3> positions(const std::vector<double>& values) {
  std::vector<Vec3> v;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) v.push_back({values[i], values[i + 1], values[i + 2]});
  return v;
}

std::vector<double> flat(const Field<PlasticState>& histories) {
  std::vector<double> values;
  values.reserve(7 * histories.size());
  for (const PlasticState& h : histories) {
    values.insert(values.end(), h.Cp_inverse.begin(), h.Cp_inverse.end());
    values.push_back(h.strain);
  }
  return values;
}

Field<PlasticState> histories(const std::vector<double>& values) {
  Field<PlasticState> h;
  for (std::size_t i = 0; i + 6 < values.size(); i += 7) {
    h.emplace_back();
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i), 6, h.back().Cp_inverse.begin());
    h.back().strain = values[i + 6];
  }
  return h;
}

Field<Tensor> tensors(const std::vector<double>& values) {
  Field<Tensor> t;
  for (std::size_t i = 0; i + 8 < values.size(); i += 9) {
    Mat3 m;
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i), 9, m.m.begin());
    t.push_back(to_tensor(m));
  }
  return t;
}

}  // namespace

Checkpoint Engine::checkpoint() const {
  const auto n = static_cast<std::size_t>(model_.system.particles());
  const StepControl::Keepsake control = control_.keepsake();
  const StepControl::Memory& step = control.memory;
  const Ledger::Books books = ledger_.books();
  Checkpoint c;
  c.arrays["reference"] = flat(model_.system.d.X);
  c.arrays["position"] = flat(state_.x.data(), n);
  c.arrays["velocity"] = flat(state_.v.data(), n);
  c.arrays["plastic"] = flat(state_.plastic);
  c.arrays["initial_position"] = flat(x0_.data(), x0_.size());
  c.arrays["time"] = {time_, dt_.before, dt_.after, model_.loads.motion.time()};
  c.arrays["step_control"] = {step.dt, step.limit, step.growth, step.smallest_J, control.smallest_J};
  c.arrays["energy"] = {books.accounts[0], books.accounts[1],      books.accounts[2], initial_energy_,
                        energy_scale_,     largest_kinetic_share_, largest_contact_,  largest_strain_};
  c.arrays["initial_momentum"] = flat({initial_momentum_.linear, initial_momentum_.angular});
  c.arrays["integrated_motion"] = flat(model_.loads.motion.integrated());
  c.arrays["spectral_vector"] = flat(control.estimator.vector.data(), control.estimator.vector.size());
  c.arrays["watched_moduli"] = control.moduli;
  for (std::size_t i = 0; i < books.last.size(); ++i) {
    c.arrays[fmt::format("last_force_{}", i)] = flat(books.last[i].force);
    c.arrays[fmt::format("last_place_{}", i)] = flat(books.last[i].place);
  }
  c.arrays["previous_deformation"] = flat(forces_.previous_deformation());
  c.integers["step"] = {step_, started_ ? 1 : 0};
  c.integers["step_control"] = {step.estimated_at, step.estimate_interval, step.watched_at, step.watch_interval,
                                control.estimator.evaluations};
  return c;
}

void Engine::check_same_model(const Checkpoint& c) const {
  if (c.array("reference") == flat(model_.system.d.X)) return;
  throw InputError(
      {c.source, 0, 0, ""},
      "the checkpoint belongs to other particles than this case makes; resume with the case that wrote it");
}

void Engine::restore(const Checkpoint& c) {
  check_same_model(c);
  const auto n = static_cast<std::size_t>(model_.system.particles());
  const std::vector<double>& time = c.array("time", 4);
  const std::vector<double>& energy = c.array("energy", 8);
  const std::vector<std::int64_t>& step = c.integer("step", 2);
  const Field<Double4> x = vectors(c.array("position", 3 * n));
  std::copy(x.begin(), x.end(), state_.x.begin());
  state_.v = vectors(c.array("velocity", 3 * n));
  state_.plastic = histories(c.array("plastic", 7 * state_.plastic.size()));
  x0_ = vectors(c.array("initial_position", 3 * x0_.size()));
  time_ = time[0];
  dt_ = {time[1], time[2]};
  step_ = step[0];
  started_ = step[1] != 0;
  const std::vector<double>& limits = c.array("step_control", 5);
  const std::vector<std::int64_t>& intervals = c.integer("step_control", 5);
  control_.restore(
      {{limits[0], limits[1], limits[2], limits[3], intervals[0], intervals[1], intervals[2], intervals[3]},
       {vectors(c.array("spectral_vector")), intervals[4]},
       c.array("watched_moduli"),
       limits[4]});
  initial_energy_ = energy[3];
  energy_scale_ = energy[4];
  largest_kinetic_share_ = energy[5];
  largest_contact_ = energy[6];
  largest_strain_ = energy[7];
  const std::vector<Vec3> momentum = positions(c.array("initial_momentum", 6));
  initial_momentum_ = {momentum[0], momentum[1]};

  model_.loads.motion.restore(time[3],
                              positions(c.array("integrated_motion", 3 * model_.loads.motion.integrated().size())));

  // The viscous stress takes its rate from the deformation one step ago.
  forces_.restore_previous_deformation(
      tensors(c.array("previous_deformation", 9 * forces_.previous_deformation().size())));
  evaluate(started_ ? dt_.after : 0.0);

  // What acts on the system must be as many as before; nothing is kept before the first step.
  const std::array<std::size_t, 3> acting{model_.loads.tractions.forces().size(), forces_.reactions().size(),
                                          model_.system.d.constraints.size()};
  Ledger::Books books{{energy[0], energy[1], energy[2]}, {}};
  for (std::size_t i = 0; i < books.last.size(); ++i) {
    const std::size_t size = step_ > 0 ? 3 * acting[i] : 0;
    books.last[i].force = positions(c.array(fmt::format("last_force_{}", i), size));
    books.last[i].place = positions(c.array(fmt::format("last_place_{}", i), size));
  }
  ledger_.restore(std::move(books));
}

}  // namespace tessera
