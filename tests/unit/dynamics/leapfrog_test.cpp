#include "tessera/dynamics/leapfrog.hpp"

#include "sample.hpp"
#include "tessera/dynamics/ledger.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera::test {
namespace {

/// A free body swinging in one of its eigenmodes with a small amplitude.
struct Swing {
  System s = system_of(discretize(Method::consistent, box({1, 1, 1}), {3, 3, 3}, 0.2, 3, nothing), rubber());
  double omega = 0.0;
  std::vector<Vec3> mode;
  static constexpr double size = 1e-7;

  Swing() {
    const Eigen::MatrixXd K = dense_stiffness(s);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (K + K.transpose()));
    const Eigen::Index first = 6;  // after six rigid modes
    omega = std::sqrt(eigen.eigenvalues()(first));
    for (Index a = 0; a < s.particles(); ++a) {
      Vec3 v;
      for (int i = 0; i < 3; ++i)
        v[i] = eigen.eigenvectors()(3 * a + i, first) / std::sqrt(s.mass[static_cast<std::size_t>(a)]);
      mode.push_back(v);
    }
  }

  /// Displacement along the mode, relative to the start, after a time in `steps` equal steps.
  double after(double time, int steps, double damping, double start_velocity) const {
    Loads loads;
    State state = reference_state(s);
    for (std::size_t a = 0; a < mode.size(); ++a) {
      state.x[a] += to_kernel(size * mode[a]);
      state.v[a] = to_kernel((size * start_velocity) * mode[a]);
    }
    Forces forces(s);
    Leapfrog leapfrog(s, loads, damping);
    const double dt = time / steps;
    forces.evaluate(state, {{}, {}, {}}, 0.0);
    leapfrog.start(state, forces, dt);
    for (int k = 0; k < steps; ++k) {
      leapfrog.prepare(state, forces, {dt, dt});
      leapfrog.step(state, forces, {dt, dt});
      forces.evaluate(state, {{}, {}, {}}, dt);
    }
    double projection = 0.0;
    for (std::size_t a = 0; a < mode.size(); ++a)
      projection += s.mass[a] * dot(mode[a], to_vec3(state.x[a]) - s.d.X[a]);
    return projection / size;
  }
};

/// Where a body under gravity is after some steps; `look` is called with the forces before each.
template <class Look>
Field<Double4> positions_after_steps(const System& s, Look&& look) {
  const Loads loads;
  State state = reference_state(s);
  for (std::size_t a = 0; a < s.d.X.size(); ++a) state.v[a] = to_kernel(Vec3{s.d.X[a].y, -s.d.X[a].x, s.d.X[a].x});
  Forces forces(s);
  const Leapfrog leapfrog(s, loads, 0.0);
  constexpr double dt = 1e-4;
  for (int k = 0; k < 3; ++k) {
    forces.evaluate(state, {{}, {}, {0.0, 0.0, -9.81}}, dt);
    look(forces);
    leapfrog.step(state, forces, {dt, dt});
  }
  return state.x;
}

TEST(LeapfrogSteps, AreAlikeWhetherForcesAreCompletedBeforeOrOnTheWay) {
  const System s = system_of(discretize(Method::consistent, box({1, 1, 1}), {12, 12, 12}, 0.2, 3, nothing), rubber());
  ASSERT_GT(s.tiles.rim.size(), 0U);
  const auto on_the_way = positions_after_steps(s, [](const Forces&) {});
  const auto before = positions_after_steps(s, [](const Forces& forces) { forces.total(); });
  const auto within_a_loop = positions_after_steps(s, [&](const Forces& forces) {
    std::vector<double> seen(s.d.X.size());
    parallel::for_each(s.particles(), [&](std::int64_t a) {
      seen[static_cast<std::size_t>(a)] = forces.total()[static_cast<std::size_t>(a)][0];
    });
    for (std::size_t a = 0; a < seen.size(); ++a) ASSERT_EQ(seen[a], forces.total()[a][0]);
  });
  for (std::size_t a = 0; a < s.d.X.size(); ++a) {
    EXPECT_EQ(to_vec3(on_the_way[a]), to_vec3(before[a]));
    EXPECT_EQ(to_vec3(on_the_way[a]), to_vec3(within_a_loop[a]));
  }
}

TEST(LeapfrogSteps, AreOfSecondOrderOnOneMode) {
  const Swing swing;
  const double v0 = 0.7 * swing.omega, time = 5.0 / swing.omega;
  const double exact = std::cos(5.0) + 0.7 * std::sin(5.0);
  const double coarse = std::abs(swing.after(time, 50, 0.0, v0) - exact);
  const double fine = std::abs(swing.after(time, 100, 0.0, v0) - exact);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

/// The damped oscillator x'' + c x' + omega^2 x = 0.
TEST(LeapfrogSteps, AreOfSecondOrderWithDamping) {
  const Swing swing;
  const double c = 0.4 * swing.omega, time = 5.0 / swing.omega;
  const double damped = std::sqrt(swing.omega * swing.omega - 0.25 * c * c);
  const double exact =
      std::exp(-0.5 * c * time) * (std::cos(damped * time) + 0.5 * c / damped * std::sin(damped * time));
  const double coarse = std::abs(swing.after(time, 50, c, 0.0) - exact);
  const double fine = std::abs(swing.after(time, 100, c, 0.0) - exact);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

/// Without forces each step multiplies the velocity by (1 - c h/2) / (1 + c h/2), exactly; steps of different length
/// take the mean of their neighbours.
TEST(LeapfrogSteps, DampFreeFlightExactly) {
  const System s = system_of(discretize(Method::delaunay, box({1, 1, 1}), {2, 2, 2}, 0.0, 1, nothing), rubber());
  Loads loads;
  const double c = 3.0;
  Leapfrog leapfrog(s, loads, c);
  Forces forces(s);
  State state = reference_state(s);
  for (Double4& v : state.v) v = Double4{2.0, 0.0, 0.0, 0.0};
  forces.evaluate(state, {{}, {}, {}}, 0.0);
  double expected = 2.0, before = 0.01;
  for (double after : {0.01, 0.02, 0.005}) {
    const double h = 0.5 * (before + after);
    leapfrog.prepare(state, forces, {before, after});
    leapfrog.step(state, forces, {before, after});
    forces.evaluate(state, {{}, {}, {}}, 0.0);
    expected *= (1.0 - 0.5 * c * h) / (1.0 + 0.5 * c * h);
    for (const Double4& v : state.v) EXPECT_NEAR(v[0], expected, 1e-12);
    before = after;
  }
}

/// velocity() interpolates between the half steps; a constant acceleration is met exactly, steps of different length
/// included.
TEST(LeapfrogSteps, ShowVelocitiesAtTheTimeOfThePositions) {
  const System s = system_of(discretize(Method::delaunay, box({1, 1, 1}), {2, 2, 2}, 0.0, 1, nothing), rubber());
  Loads loads;
  const Vec3 g{0, 0, -9.81};
  Leapfrog leapfrog(s, loads, 0.0);
  Forces forces(s);
  State state = reference_state(s);
  forces.evaluate(state, {{}, {}, g}, 0.0);
  leapfrog.start(state, forces, 0.01);
  double before = 0.01, t = 0.0;
  for (double after : {0.01, 0.02, 0.005, 0.03}) {
    const StepPair dt{before, after};
    leapfrog.prepare(state, forces, dt);
    EXPECT_NEAR(leapfrog.velocity(state, forces, dt, 3).z, g.z * t, 1e-13);
    leapfrog.step(state, forces, dt);
    t += after;
    forces.evaluate(state, {{}, {}, g}, 0.0);
    before = after;
  }
}

/// Constrained particles arrive where they are told, free components move as free ones do, and the reaction is what
/// is missing from m a.
TEST(LeapfrogSteps, BringConstrainedParticlesToTheirPlace) {
  const Constrain constrain = [](const Vec3& X, const Vec3&) { return X.x < 1e-9 ? diagonal(1, 0, 1) : Mat3{}; };
  const System s = system_of(discretize(Method::delaunay, box({1, 1, 1}), {2, 2, 2}, 0.0, 1, constrain), rubber());
  BoundaryCondition c;
  const Origin nowhere;
  c.kind = PrescribedDisplacement{{Formula("0.01*sin(20*t)", nowhere), std::nullopt, Formula("0.003*t", nowhere)}};
  std::vector<Vec3> X;
  std::vector<PointConstraint> constraints;
  for (const ParticleConstraint& p : s.d.constraints) {
    X.push_back(s.d.X[static_cast<std::size_t>(p.particle)]);
    constraints.push_back({p.D, {{&c, p.D}}});
  }
  Loads loads{PrescribedMotion(X, constraints, std::vector<Vec3>(X.size())), {}, {}};
  Leapfrog leapfrog(s, loads, 0.5);
  Forces forces(s);
  State state = reference_state(s);
  const double dt = 1e-3;
  forces.evaluate(state, {{}, {}, {}}, 0.0);
  for (int k = 0; k < 50; ++k) {
    loads.motion.move_to((k + 1) * dt);
    if (k == 0) leapfrog.start(state, forces, dt);
    leapfrog.prepare(state, forces, {dt, dt});
    const State old = state;
    leapfrog.step(state, forces, {dt, dt});
    for (std::size_t i = 0; i < X.size(); ++i) {
      const auto a = static_cast<std::size_t>(s.d.constraints[i].particle);
      const Vec3 u = to_vec3(state.x[a]) - X[i];
      EXPECT_NEAR(u.x, 0.01 * std::sin(20 * (k + 1) * dt), 1e-15);
      EXPECT_NEAR(u.z, 0.003 * (k + 1) * dt, 1e-15);
      // m (v+ - v-)/dt + c m (v+ + v-)/2 = f - reaction
      const Vec3 v0 = to_vec3(old.v[a]), v1 = to_vec3(state.v[a]);
      const Vec3 inertia = (s.mass[a] / dt) * (v1 - v0) + (0.25 * s.mass[a]) * (v1 + v0);
      const Vec3 rest = to_vec3(forces.total()[a]) - leapfrog.reactions()[i] - inertia;
      EXPECT_LT(norm(rest), 1e-9);
      EXPECT_EQ(leapfrog.reactions()[i].y, 0.0);
    }
    forces.evaluate(state, {{}, {}, {}}, dt);
  }
}

}  // namespace
}  // namespace tessera::test
