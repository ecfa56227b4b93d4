#include "tessera/loads/condition_values.hpp"

#include <numbers>

#include "sample.hpp"
#include "tessera/loads/side_normals.hpp"

namespace tessera::test {
namespace {

FormulaVec3 formulas(const std::string& x, const std::string& y, const std::string& z) {
  const Origin nowhere{"case.toml", 1, 1, "formula"};
  return {Formula(x, nowhere, FormulaNames::face), Formula(y, nowhere, FormulaNames::face),
          Formula(z, nowhere, FormulaNames::face)};
}

double difference(const Mat3& a, const Mat3& b) { return std::sqrt(contract(a - b, a - b)); }

TEST(Rotation, IsRightHandedAboutItsAxis) {
  const Mat3 R = rotation_about({0, 0, 1}, 0.5 * std::numbers::pi);
  EXPECT_LT(norm(R * Vec3{1, 0, 0} - Vec3{0, 1, 0}), 1e-15);
  const Vec3 axis = normalized(Vec3{1, -2, 3});
  const Mat3 S = rotation_about(axis, 2.5);
  EXPECT_LT(norm(S * axis - axis), 1e-15);
  EXPECT_LT(difference(S * transpose(S), identity()), 1e-15);
  EXPECT_NEAR(determinant(S), 1.0, 1e-15);
  EXPECT_NEAR(trace(S), 1.0 + 2.0 * std::cos(2.5), 1e-15);
}

/// x = R (X - point) + point + displacement, the angle a formula of time or of the place.
TEST(Rotation, MovesPointsAboutAPointAndAlong) {
  const Vec3 X{2, 1, 7};
  const auto moved = [&](const std::string& angle) {
    const BoundaryCondition c =
        entry(1, {}, PrescribedRotation{{0, 0, 1}, {1, 1, 0}, *formula(angle), formulas("t", "0", "Z*t")});
    return X + MotionValues(c, 2.0).at(X);
  };
  EXPECT_LT(norm(moved("pi*t/4") - Vec3{1 + 2, 2, 7 + 14}), 1e-14);
  EXPECT_LT(norm(moved("pi*Z/7") - Vec3{0 + 2, 1, 7 + 14}), 1e-14);
}

TEST(HeldDirections, OfNormalAndTangentialDisplacementsCompleteEachOther) {
  const Vec3 N = normalized(Vec3{1, 2, -0.5}), wanted{0.3, -0.2, 0.7};
  const BoundaryCondition along = entry(1, {}, NormalDisplacement{*formula("0.1*t+X")});
  const BoundaryCondition across = entry(2, {}, TangentialDisplacement{formulas("0.3", "-0.2", "0.7")});
  const HeldDirections n = held_directions(along, N), t = held_directions(across, N);
  EXPECT_LT(difference(n.D + t.D, identity()), 1e-15);
  const Vec3 X{4, 0, 0}, u = n.M * MotionValues(along, 2.0).at(X) + t.M * MotionValues(across, 2.0).at(X);
  EXPECT_NEAR(dot(u, N), 4.2, 1e-14);
  EXPECT_LT(norm((u - dot(u, N) * N) - (wanted - dot(wanted, N) * N)), 1e-15);
}

/// T = P N for a stress; every load's formulas know the normal.
TEST(TractionValues, KnowTheNormal) {
  const Vec3 N{0, 0.6, 0.8}, X{1, 2, 3};
  const auto value = [&](decltype(BoundaryCondition::kind) kind) {
    const BoundaryCondition c = entry(1, {}, std::move(kind));
    return TractionValues(c, 2.0).at(X, N);
  };
  const Vec3 stress =
      value(NominalStress{{formulas("1", "2", "3"), formulas("4*t", "5", "6"), formulas("7", "8*X", "Y")}});
  EXPECT_LT(norm(stress - Vec3{1.2 + 2.4, 3.0 + 4.8, 4.8 + 1.6}), 1e-14);
  EXPECT_LT(norm(value(NominalTraction{formulas("nx", "10*ny*t", "nz+Z")}) - Vec3{0, 12, 3.8}), 1e-14);
  const Vec3 p = value(NominalPressure{formulas("5*ny", "0", "0")[0]});
  EXPECT_LT(norm(p + 3.0 * N), 1e-14);
  const Vec3 same = value(FollowingPressure{formulas("5*ny", "0", "0")[0]});
  EXPECT_EQ(same, p);
}

TEST(Formulas, KnowTheNormalOnFacesOnly) {
  EXPECT_THROW(Formula("nx", {"case.toml", 1, 1, "x"}), InputError);
  const Formula original("nx+2*nz", {"case.toml", 1, 1, "x"}, FormulaNames::face);
  const Formula copy = original;
  EXPECT_EQ(copy(0.0, {}, {0.6, 0, 0.8}), 0.6 + 1.6);
  EXPECT_TRUE(copy.depends_on_position());
}

/// A prism of n facets around the z axis, one triangle pair each, as a surface with particles at its corners.
struct Prism {
  Surface surface;
  std::vector<Vec3> X;

  explicit Prism(int n) {
    surface.body = "prism";
    surface.side_names = {{"round"}};
    surface.known_names = {"round"};
    surface.lower = {-1, -1, 0};
    surface.upper = {1, 1, 1};
    for (int i = 0; i < n; ++i) {
      const double phi = 2.0 * std::numbers::pi * i / n;
      for (const double z : {0.0, 1.0}) X.push_back({std::cos(phi), std::sin(phi), z});
    }
    for (int i = 0; i < n; ++i) {
      const Index a = 2 * i, b = a + 1, c = 2 * ((i + 1) % n), d = c + 1;
      const double phi = 2.0 * std::numbers::pi * (i + 0.5) / n;
      const Vec3 N{std::cos(phi), std::sin(phi), 0};
      surface.pieces.push_back({{}, N, 0, {a, c, d}});
      surface.pieces.push_back({{}, N, 0, {a, d, b}});
    }
  }
};

/// Facets of a curved side give one normal, the true one, and leave the sliding along it free; sharper edges hold both
/// facets' normals.
TEST(CurvedSides, HaveOneNormalAtEveryParticle) {
  for (const auto& [facets, sides] : {std::pair{10, 1U}, {40, 1U}, {8, 2U}, {4, 2U}}) {
    const Prism prism(facets);
    const Taken all{std::vector<char>(prism.surface.pieces.size(), 1), std::vector<char>(prism.X.size(), 1)};
    for (std::size_t a = 0; a < prism.X.size(); ++a) {
      const std::vector<Vec3> normals = side_normals(prism.surface, prism.X, all)[a];
      ASSERT_EQ(normals.size(), sides) << facets;
      if (sides == 2) continue;
      EXPECT_LT(norm(normals[0] - Vec3{prism.X[a].x, prism.X[a].y, 0}), 1e-14);
    }
  }
}

TEST(CurvedSides, MoveAlongTheirNormals) {
  const Prism prism(24);
  const std::vector<BoundaryCondition> conditions{entry(3, {"round"}, NormalDisplacement{*formula("0.1*t")})};
  const auto list = constrain_particles(prism.surface, prism.X, pointers(conditions), 1.0);
  PrescribedMotion motion(prism.X, list, std::vector<Vec3>(prism.X.size()));
  motion.move_to(2.0);
  for (std::size_t a = 0; a < prism.X.size(); ++a) {
    const Vec3 N{prism.X[a].x, prism.X[a].y, 0};
    EXPECT_LT(difference(list[a].D, outer(N, N)), 1e-13);
    EXPECT_LT(norm(motion.positions()[a] - prism.X[a] - 0.2 * N), 1e-13);
  }
}

/// Particles at the rim of a formula on a curved side, without a whole facet, slide along it too.
TEST(CurvedSides, LendTheirNormalsToTheRimOfAFormula) {
  const Prism prism(24);
  const std::vector<BoundaryCondition> conditions{entry(3, {"X > 0 && Z < 0.5 || X > 0.5"}, Condition::symmetric)};
  const auto list = constrain_particles(prism.surface, prism.X, pointers(conditions), 1.0);
  for (std::size_t a = 0; a < prism.X.size(); ++a) {
    const Vec3 N{prism.X[a].x, prism.X[a].y, 0};
    const bool taken = (N.x > 0.0 && prism.X[a].z < 0.5) || N.x > 0.5;
    EXPECT_LT(difference(list[a].D, taken ? outer(N, N) : Mat3{}), 0.3) << a;
    EXPECT_EQ(is_zero(list[a].D), !taken);
  }
}

/// A normal displacement at the edge of two sides meets both; one that contradicts a fixed neighbour is an error.
TEST(NormalDisplacements, MeetAtEdges) {
  const auto [surface, X, N1, N2] = Wedge();
  std::vector<BoundaryCondition> conditions{entry(3, {"one"}, NormalDisplacement{*formula("t")}),
                                            entry(4, {"two"}, NormalDisplacement{*formula("3*t")})};
  const auto list = constrain_particles(surface, X, pointers(conditions), 1.0);
  PrescribedMotion motion({X[0]}, {list[0]}, std::vector<Vec3>(1));
  motion.move_to(0.5);
  EXPECT_NEAR(dot(motion.positions()[0], N1), 0.5, 1e-14);
  EXPECT_NEAR(dot(motion.positions()[0], N2), 1.5, 1e-14);
  conditions.push_back(entry(9, {"two"}, Condition::fixed));
  const std::string message = message_of([&] { constrain_particles(surface, X, pointers(conditions), 1.0); });
  EXPECT_TRUE(contains(message, "case.toml:9")) << message;
}

}  // namespace
}  // namespace tessera::test
