#include <gtest/gtest.h>

#include "support/small_bodies.hpp"
#include "tessera/dynamics/time_step.hpp"

namespace tessera::test {
namespace {

System small_system() {
  return system_of(discretize(Method::delaunay, box({1, 1, 1}), {2, 2, 2}, 0.0, 1, nothing), rubber());
}

TimeSpec fixed(double end, double dt) {
  TimeSpec spec;
  spec.end = end;
  spec.step = FixedStep{dt, false};
  return spec;
}

/// The steps that a run takes when time adds up as in a run.
std::vector<double> steps_of(const TimeSpec& spec) {
  const System system = small_system();
  const State state = reference_state(system);
  StepControl control(spec, system, state, {});
  std::vector<double> steps;
  for (double time = 0.0; time < spec.end;) {
    const double dt = control.next(time);
    time = dt >= spec.end - time ? spec.end : time + dt;
    steps.push_back(dt);
  }
  return steps;
}

TEST(LastStep, RoundOffOfManyStepsIsNoStepOfItsOwn) {
  for (const double end : {0.3, 1.0, 1.5, 2.0}) {
    TimeSpec spec;
    spec.end = end;
    spec.safety = 3e-4 / end;  // some 100 000 steps
    const std::vector<double> steps = steps_of(spec);
    EXPECT_GT(steps.size(), 10000u);
    EXPECT_NEAR(steps.back() / steps.front(), 1.0, 1e-3) << end;
  }
}

TEST(LastStep, TakesWhatAFixedStepLeaves) {
  const std::vector<double> steps = steps_of(fixed(0.01, 0.0003));
  ASSERT_EQ(steps.size(), 34u);
  EXPECT_NEAR(steps.back(), 0.0001, 1e-12);
}

TEST(LastStep, IsTheWholeRunWhenTheStepIsLonger) {
  const std::vector<double> steps = steps_of(fixed(0.0001, 0.0003));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_DOUBLE_EQ(steps.front(), 0.0001);
}

}  // namespace
}  // namespace tessera::test
