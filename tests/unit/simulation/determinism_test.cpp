#include "sample.hpp"

namespace tessera::test {
namespace {

/// Faces of all kinds, traction, gravity, viscosity and damping at once.
Case busy_case(Method method, std::array<int, 3> counts) {
  Case c = cube_case(method, counts, 0.2);
  c.materials[0].viscosity = {0.1, 0.1};
  c.boundary = {condition({"-x"}, Condition::symmetric), condition({"-z"}, Condition::fixed),
                condition({"+z"}, PrescribedVelocity{{std::nullopt, formula("0.3*t*X"), formula("-0.1")}}),
                condition({"+x"}, NominalTraction{formulas("1000*t", "200*Y", "0")}),
                condition({"+y"}, NominalPressure{formula("500*sin(30*t)")})};
  c.initial = {initial_velocity(formulas("0.1*Y", "0", "0.05*X"))};
  c.gravity = {0, 0, -9.81};
  c.time.damping = 2.0;
  c.time.step = AutoStep{};
  c.time.safety = 0.3;
  return c;
}

class Determinism : public testing::TestWithParam<Method> {
 protected:
  ~Determinism() override { parallel::set_threads(before_); }

 private:
  int before_ = parallel::threads();
};

struct Outcome {
  Checkpoint state;
  Snapshot shot;
  EnergyLedger energies;
  std::vector<Vec3> reactions;
};

Outcome run_with(int threads, const Case& c, int steps) {
  parallel::set_threads(threads);
  Running run(c);
  run.advance(steps);
  Outcome outcome;
  outcome.state = run.engine.checkpoint();
  run.engine.prepare();
  outcome.shot = run.engine.snapshot();
  outcome.energies = run.engine.energies();
  outcome.reactions = run.engine.reactions();
  return outcome;
}

/// More than 10000 particles: set-up, ten steps, sums and reactions have the same bits on one and on two threads.
TEST_P(Determinism, TwoThreadsGiveTheBitsOfOne) {
  const int n = GetParam() == Method::delaunay ? 21 : 22;
  const Case c = busy_case(GetParam(), {n, n, n});
  const Outcome one = run_with(1, c, 10), two = run_with(2, c, 10);
  EXPECT_GT(one.shot.position.size(), 10000U);
  expect_same(one.state, two.state);
  EXPECT_EQ(one.shot.internal_force, two.shot.internal_force);
  EXPECT_EQ(one.shot.deformation_gradient, two.shot.deformation_gradient);
  EXPECT_EQ(one.energies.kinetic, two.energies.kinetic);
  EXPECT_EQ(one.energies.internal, two.energies.internal);
  EXPECT_EQ(one.energies.contact, two.energies.contact);
  EXPECT_EQ(one.energies.external_work, two.energies.external_work);
  EXPECT_EQ(one.energies.dissipated, two.energies.dissipated);
  EXPECT_EQ(one.reactions, two.reactions);
}

/// A run that stops in the middle and goes on in a new engine ends bitwise where an unbroken one ends, its books
/// included. The checkpoint goes through a file.
TEST_P(Determinism, CheckpointsContinueBitwise) {
  Case c = busy_case(GetParam(), {3, 3, 3});
  c.time.step = AutoSpectralStep{};
  c.time.safety = 0.2;
  c.time.end = 0.2;
  const std::string path = testing::TempDir() + "/middle_" + name_of(GetParam()) + ".h5";
  Running whole(c);
  for (int steps : {0, 1, 7}) {
    whole.advance(steps);
    write_checkpoint(path, whole.engine.checkpoint());
    Running rest(c);
    rest.engine.restore(read_checkpoint(path));
    EXPECT_EQ(rest.engine.time(), whole.engine.time());
    EXPECT_EQ(rest.engine.steps(), whole.engine.steps());
    expect_same(rest.engine.checkpoint(), whole.engine.checkpoint());
    Running unbroken(c);
    unbroken.advance(static_cast<int>(whole.engine.steps()));
    rest.finish();
    unbroken.finish();
    EXPECT_GT(rest.engine.steps(), 20);
    expect_same(rest.engine.checkpoint(), unbroken.engine.checkpoint());
    EXPECT_EQ(rest.engine.energies().error(), unbroken.engine.energies().error());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Determinism, testing::ValuesIn(all_methods),
                         [](const auto& param) { return name_of(param.param); });

/// A checkpoint of other particles, or of other conditions on the same ones, is refused.
TEST(Checkpoints, OfOtherModelsAreRefused) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    const Case c = busy_case(method, {3, 3, 3});
    Running run(c);
    run.advance(3);
    const Checkpoint state = run.engine.checkpoint();

    Case other = c;
    std::get<LatticeSpec>(other.bodies[0].particles.source).seed = 99;
    Running moved(other);
    EXPECT_TRUE(contains(message_of<InputError>([&] { moved.engine.restore(state); }), "other particles"));

    for (std::size_t dropped : {0U, 3U, 4U}) {  // a constraint, a traction, a pressure
      Case less = c;
      less.boundary.erase(less.boundary.begin() + static_cast<std::ptrdiff_t>(dropped));
      Running fewer(less);
      EXPECT_NE(message_of<InputError>([&] { fewer.engine.restore(state); }), "") << name_of(method) << dropped;
    }
  }
}

}  // namespace
}  // namespace tessera::test
