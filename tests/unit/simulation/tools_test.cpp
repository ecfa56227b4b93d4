#include "sample.hpp"
#include "tessera/loads/condition_values.hpp"
#include "tessera/simulation/recorder.hpp"

namespace tessera::test {
namespace {

const Vec3 axis = normalized(Vec3{1, 2, -1}), point{0.3, 0.7, 0.2};
constexpr double angle = 1.9;

Vec3 turned(const Vec3& X) { return point + rotation_about(axis, angle) * (X - point) + Vec3{0.1, -0.4, 0.2}; }

std::string number(double x) { return "(" + Formula(x).text() + ")"; }

/// The displacement of `turned` as formulas.
FormulaVec3 turned_displacement() {
  const Mat3 A = rotation_about(axis, angle) - identity();
  const Vec3 b = turned({});
  std::array<std::string, 3> text;
  for (int i = 0; i < 3; ++i)
    text[static_cast<std::size_t>(i)] =
        number(A(i, 0)) + "*X+" + number(A(i, 1)) + "*Y+" + number(A(i, 2)) + "*Z+" + number(b[i]);
  return formulas(text[0], text[1], text[2]);
}

BoundaryCondition turning(std::vector<std::string> where) {
  return condition(std::move(where), PrescribedRotation{axis, point, Formula(angle), formulas("0.1", "-0.4", "0.2")});
}

/// A body in rotated clamps, moved along with them, has no strain and no force.
TEST(RotatedClamps, GiveAnExactRigidMotion) {
  for (const Method method : all_methods) {
    Case c = cube_case(method, {3, 3, 3}, 0.25);
    c.time.end = 0.0;
    c.boundary = {turning({"-x", "+x", "-y", "+z"})};
    c.initial = {{"", turned_displacement(), formulas("0", "0", "0"), {}}};
    Running run(c);
    run.engine.prepare();
    const Snapshot shot = run.engine.snapshot();
    for (std::size_t a = 0; a < shot.position.size(); ++a) {
      EXPECT_LT(norm(shot.position[a] - turned(shot.reference_position[a])), 1e-14);
      EXPECT_LT(std::sqrt(contract(shot.first_piola_kirchhoff[a], shot.first_piola_kirchhoff[a])), 1e-12 * 1e6)
          << name_of(method);
      EXPECT_LT(norm(shot.force[a]), 1e-12 * 1e6) << name_of(method);
    }
  }
}

/// Of a body at rest between a wall and a turning tool both torques balance; a twist about the axis has no net force.
TEST(ReactionTorques, BalanceAtRest) {
  for (const Method method : {Method::delaunay, Method::consistent}) {
    Case c = cube_case(method, {3, 3, 3}, 0.2);
    c.time.damping = 60.0;
    c.time.end = 0.8;
    c.time.step = AutoStep{};
    c.boundary = {condition({"-z"}, Condition::fixed),
                  condition({"+z"}, PrescribedRotation{
                                        {0, 0, 1}, {0.5, 0.5, 0}, formula("0.2*min(1,5*t)"), formulas("0", "0", "0")})};
    for (const std::string side : {"-z", "+z"}) {
      ProbeSpec probe;
      probe.name = side;
      probe.where = SelectionSpec{{side}, {}};
      probe.about = {0.5, 0.5, 3.0};
      c.probes.push_back(probe);
    }
    Running run(c);
    run.finish();
    const HistoryRows rows(c, run.model, run.engine, run.engine.snapshot());
    const std::vector<double> row = rows.row(run.engine);
    const std::size_t first = row.size() - 12;  // fx fy fz tx ty tz of both
    ASSERT_EQ(rows.columns()[first + 5].name, "-z.tz");
    EXPECT_GT(row[first + 5], 5e3) << name_of(method);  // the tool turns the body right-handed, the body turns the wall
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(row[first + i], -row[first + 6 + i], 1e-3 * row[first + 5]) << name_of(method) << " " << i;
  }
}

/// On a cell face that is held in part a pressure that follows would lose what the constraint holds.
TEST(FollowingPressures, NeedFacesThatAreFree) {
  Case c = cube_case(Method::consistent);
  c.boundary = {condition({"+x"}, PrescribedDisplacement{{std::nullopt, formula("0"), std::nullopt}}),
                condition({"+x"}, FollowingPressure{formula("1")})};
  const std::string message = message_of<InputError>([&] { build_model(c); });
  EXPECT_TRUE(contains(message, "case.toml:10")) << message;
  EXPECT_TRUE(contains(message, "no effect")) << message;
}

}  // namespace
}  // namespace tessera::test
