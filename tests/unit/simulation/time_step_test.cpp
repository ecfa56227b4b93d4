#include <cmath>

#include "sample.hpp"

namespace tessera::test {
namespace {

/// A block between frictionless walls that is compressed to `rest` of its height within a second.
Case compression(Method method, const std::string& rest) {
  Case c = cube_case(method, {5, 5, 5}, 0.25);
  c.boundary = {condition({"-x", "+x", "-y", "+y", "-z"}, Condition::symmetric),
                condition({"+z"}, PrescribedDisplacement{
                                      {std::nullopt, std::nullopt, formula("(" + rest + "-1)*(1-cos(pi*t))/2")}})};
  c.time.end = 1.0;
  c.time.damping = 20.0;
  c.time.step = AutoSpectralStep{};
  c.time.safety = 0.8;
  return c;
}

/// Its wave modulus grows twentyfold. A step chosen at the start is soon too long; an adapted one stays stable.
TEST(SpectralSteps, FollowTheStiffeningOfACompressedBlock) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    Case c = compression(method, "0.25");
    Running adapted(c);
    const double first = adapted.engine.step_control().memory().dt;
    double largest_error = 0.0;
    adapted.finish([&](const Engine& e) {
      if (e.steps() > 50) largest_error = std::max(largest_error, e.energies().relative_error());
    });
    EXPECT_LT(largest_error, 2e-3) << name_of(method);
    EXPECT_LT(adapted.engine.dt(), 0.6 * first) << name_of(method);
    c.time.step = FixedStep{first, false};
    Running frozen(c);
    EXPECT_THROW(frozen.finish([&](const Engine& e) {
      e.verify_deformation();
      if (e.steps() > 50 && !(e.energies().relative_error() < 0.1)) throw RunError("unstable");
    }),
                 RunError)
        << name_of(method);
  }
}

/// A blow stiffens the body within few steps; the deformation is looked at when the smallest J falls, not only by plan.
TEST(SpectralSteps, FollowABlow) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    Case c = compression(method, "0.4");
    std::get<PrescribedDisplacement>(c.boundary[1].kind).components[2] = formula("-0.4*(1-exp(-t/0.04))");
    c.time.damping = 0.0;
    c.materials[0].viscosity = {0.3, 1.0};
    c.time.end = 0.2;
    Running run(c);
    run.finish([&](const Engine& e) { e.verify_deformation(); });
    EXPECT_LT(run.engine.energies().relative_error(), 0.05) << name_of(method);
  }
}

/// Two in a hundred, from three hundred steps on.
TEST(SpectralSteps, AreChosenCheaply) {
  for (Method method : all_methods)
    for (double end : {3.0, 10.0, 40.0}) {
      Case c = cube_case(method);
      c.boundary = {condition({"-x", "+x", "-y", "+y", "-z", "+z"}, Condition::fixed)};
      c.initial = {initial_velocity(formulas("0.5*Y*(1-Y)", "0", "0.8*X*Y"))};
      c.time.step = AutoSpectralStep{};
      c.time.safety = 0.8;
      c.time.end = end;
      Running run(c);
      run.finish();
      EXPECT_GT(run.engine.steps(), 300);
      EXPECT_LE(static_cast<double>(run.engine.step_control().evaluations()),
                std::max(0.02 * static_cast<double>(run.engine.steps()), 6.0))
          << name_of(method) << " " << run.engine.steps();
    }
}

double wall_force(const Engine& e) {
  double sum = 0.0;
  for (const Vec3& r : e.reactions()) sum += 0.5 * std::abs(r.z);
  return sum;
}

/// Slow compression by one per cent with steps three and a half times as long: the same force, hardly any motion.
TEST(MassScaling, KeepsTheForceOfASlowCompression) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    Case c = compression(method, "0.99");
    c.boundary[0] = condition({"-x", "-y", "-z"}, Condition::symmetric);
    c.time.end = 4.0;
    std::get<PrescribedDisplacement>(c.boundary[1].kind).components[2] = formula("-0.01*(1-cos(pi*t/4))/2");
    Running plain(c);
    plain.finish();
    const double step = plain.engine.step_control().memory().dt;
    c.time.mass_scaling = {3.5 * step, {}};
    Running scaled(c);
    scaled.finish([](const Engine&) {});
    scaled.engine.verify_energy();
    EXPECT_LT(3.0 * static_cast<double>(scaled.engine.steps()), static_cast<double>(plain.engine.steps()));
    EXPECT_NEAR(wall_force(scaled.engine) / wall_force(plain.engine), 1.0, 0.01) << name_of(method);
    EXPECT_GT(scaled.engine.mass_scaling()->added_share, 0.0);
    EXPECT_LT(scaled.engine.largest_kinetic_share(), 0.01);
    EXPECT_LT(scaled.engine.energies().relative_error(), 1e-3);
  }
}

/// Gravity acts on the true mass, so a free body gains the momentum of its weight, no more, and falls more slowly.
TEST(MassScaling, LeavesTheWeightAsItIs) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    Case c = cube_case(method);
    c.gravity = {0, 0, -10};
    c.time.end = 0.5;
    c.time.step = AutoSpectralStep{};
    c.time.safety = 0.8;
    c.time.mass_scaling = {0.05, {}};
    Running run(c);
    run.finish();
    const double added = run.engine.mass_scaling()->added;
    EXPECT_GT(added, 100.0);
    EXPECT_NEAR(run.engine.momentum().linear.z, -1000.0 * 10.0 * 0.5, 1e-6);
    double moved = 0.0;
    for (double m : run.engine.snapshot().mass) moved += m;
    EXPECT_NEAR(moved, 1000.0 + added, 1e-6);
    EXPECT_NEAR(run.engine.momentum().linear.x, 0.0, 1e-9);
    EXPECT_LT(run.engine.energies().relative_error(), 1e-3);
  }
}

TEST(MassScaling, IsRefusedWhereInertiaMatters) {
  Case c = cube_case(Method::consistent);
  c.time.step = AutoSpectralStep{};
  c.time.mass_scaling = {0.05, {"case.toml", 33, 1, "time.mass_scaling"}};
  c.initial = {initial_velocity(formulas("1", "0", "0"))};
  EXPECT_THROW(Running run(c), InputError);
  c = cube_case(Method::quasi_static);
  c.time.step = AutoSpectralStep{};
  c.time.mass_scaling = {0.05, {"case.toml", 33, 1, "time.mass_scaling"}};
  EXPECT_THROW(Running run(c), InputError);
}

}  // namespace
}  // namespace tessera::test
