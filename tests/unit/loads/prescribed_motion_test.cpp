#include "sample.hpp"

namespace tessera::test {
namespace {

/// One point under one entry with all of D.
PrescribedMotion one_point(const BoundaryCondition& c, const Mat3& M, const Vec3& X, const Vec3& initial) {
  const std::vector<Vec3> start{initial};
  return PrescribedMotion({X}, {PointConstraint{M, {{&c, M}}}}, start);
}

TEST(PrescribedMotionOfPoints, FollowsFormulasOfTimeAndPlace) {
  const BoundaryCondition c =
      entry(1, {}, PrescribedDisplacement{{formula("t*X"), formula("sin(t)+Y*Z"), formula("3")}});
  const Vec3 X{2, 3, 5};
  PrescribedMotion motion = one_point(c, identity(), X, {});
  EXPECT_EQ(motion.positions()[0], (X + Vec3{0, 15, 3}));
  motion.move_to(0.5);
  EXPECT_LT(norm(motion.positions()[0] - (X + Vec3{1, std::sin(0.5) + 15, 3})), 1e-14);
}

/// The mean over a rectangle of 2 x 1 m in the plane Z = 3, whose half axes are spread by sqrt(2 I / A).
TEST(PrescribedMotionOfPoints, AveragesQuadraticMotionOverFaces) {
  const BoundaryCondition c =
      entry(1, {}, PrescribedDisplacement{{formula("X^2"), formula("X*Y + Y^2"), formula("t")}});
  const Vec3 X{1, 0.5, 3};
  const FaceSpread face{{std::sqrt(2.0 / 3.0), 0, 0}, {0, std::sqrt(2.0 / 12.0), 0}};
  PrescribedMotion motion({X}, {PointConstraint{identity(), {{&c, identity()}}}}, std::vector<Vec3>(1), {face});
  motion.move_to(2.0);
  EXPECT_LT(norm(motion.positions()[0] - (X + Vec3{4.0 / 3.0, 0.5 + 1.0 / 3.0, 2.0})), 1e-14);
}

TEST(PrescribedMotionOfPoints, LeavesFreeComponentsAtTheirReference) {
  const BoundaryCondition c = entry(1, {}, PrescribedDisplacement{{std::nullopt, formula("t"), std::nullopt}});
  PrescribedMotion motion = one_point(c, diagonal(0, 1, 0), {1, 1, 1}, {7, 7, 7});
  motion.move_to(2.0);
  EXPECT_EQ(motion.positions()[0], (Vec3{1, 3, 1}));
}

/// Velocities start from the initial displacement, only where they are prescribed, and are integrated by the midpoint
/// rule: exact for linear ones, of second order otherwise.
TEST(PrescribedMotionOfPoints, IntegratesVelocities) {
  const BoundaryCondition linear = entry(1, {}, PrescribedVelocity{{formula("2*t"), std::nullopt, formula("X")}});
  PrescribedMotion motion = one_point(linear, diagonal(1, 0, 1), {4, 0, 0}, {0.5, 0.5, 0.5});
  for (double t : {0.1, 0.35, 1.0}) motion.move_to(t);
  EXPECT_LT(norm(motion.positions()[0] - Vec3{4 + 0.5 + 1.0, 0, 0.5 + 4.0}), 1e-14);

  const BoundaryCondition cosine = entry(1, {}, PrescribedVelocity{{formula("cos(t)"), {}, {}}});
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) {
    PrescribedMotion m = one_point(cosine, diagonal(1, 0, 0), {}, {});
    const int n = k == 0 ? 20 : 40;
    for (int i = 1; i <= n; ++i) m.move_to(2.0 * i / n);
    error[static_cast<std::size_t>(k)] = std::abs(m.positions()[0].x - std::sin(2.0));
  }
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.05);
}

TEST(PrescribedMotionOfPoints, GoesOnFromWhatWasKept) {
  const BoundaryCondition c = entry(1, {}, PrescribedVelocity{{formula("exp(t)"), formula("X*t"), {}}});
  PrescribedMotion whole = one_point(c, diagonal(1, 1, 0), {3, 0, 0}, {1, 1, 1}), second = whole;
  whole.move_to(0.3);
  second.restore(whole.time(), whole.integrated());
  EXPECT_EQ(second.positions()[0], whole.positions()[0]);
  whole.move_to(0.5);
  second.move_to(0.5);
  EXPECT_EQ(second.positions()[0], whole.positions()[0]);
}

TEST(PrescribedMotionOfPoints, AddsTheSharesOfSeveralEntries) {
  const BoundaryCondition a = entry(1, {}, PrescribedDisplacement{{formula("t"), {}, {}}});
  const BoundaryCondition b = entry(2, {}, PrescribedVelocity{{std::nullopt, formula("3"), {}}});
  const BoundaryCondition c = entry(3, {}, Condition::symmetric);
  PointConstraint p;
  p.D = identity();
  p.parts = {{&a, diagonal(1, 0, 0)}, {&b, diagonal(0, 1, 0)}, {&c, diagonal(0, 0, 1)}};
  PrescribedMotion motion({Vec3{1, 1, 1}}, {p}, std::vector<Vec3>(1));
  motion.move_to(2.0);
  EXPECT_LT(norm(motion.positions()[0] - Vec3{3, 7, 1}), 1e-14);
}

}  // namespace
}  // namespace tessera::test
