#include "tessera/loads/assignment.hpp"

#include "sample.hpp"

namespace tessera::test {
namespace {

double difference(const Mat3& a, const Mat3& b) { return std::sqrt(contract(a - b, a - b)); }

struct VoronoiBlock {
  Solid solid = box({1, 1, 1});
  VoronoiBody body = voronoi_body(solid, {3, 3, 3}, 0.2, 1, nothing);
  Surface surface = surface_of(solid, body.cells);

  std::vector<PointConstraint> constrain(const std::vector<BoundaryCondition>& c) const {
    return constrain_faces(surface, pointers(c));
  }
};

struct DelaunayBlock {
  Solid solid = box({1, 1, 1});
  TetrahedralMesh mesh = tetrahedra(solid, {2, 2, 2}, 0.0, 1);
  Surface surface = surface_of(solid, mesh);

  std::vector<PointConstraint> constrain(const std::vector<BoundaryCondition>& c, double end = 1.0) const {
    return constrain_particles(surface, mesh.points, pointers(c), end);
  }
  const PointConstraint& at(const std::vector<PointConstraint>& list, const Vec3& X) const {
    for (std::size_t a = 0; a < mesh.points.size(); ++a)
      if (norm(mesh.points[a] - X) < 1e-9) return list[a];
    throw std::runtime_error("no particle there");
  }
};

/// [V 14], and components.
TEST(ConstrainFaces, GivesTheProjectionOfEachCondition) {
  const VoronoiBlock block;
  const Mat3 NN = diagonal(1, 0, 0);
  const std::vector<std::pair<decltype(BoundaryCondition::kind), Mat3>> conditions{
      {Condition::fixed, identity()},
      {Condition::symmetric, NN},
      {Condition::antisymmetric, identity() - NN},
      {Condition::free, Mat3{}},
      {PrescribedDisplacement{{std::nullopt, formula("t"), std::nullopt}}, diagonal(0, 1, 0)},
      {PrescribedVelocity{{formula("1"), std::nullopt, formula("0")}}, diagonal(1, 0, 1)},
  };
  for (const auto& [kind, D] : conditions) {
    const auto faces = block.constrain({entry(3, {"+x"}, kind)});
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const bool taken = block.surface.pieces[i].N.x > 0.5;
      EXPECT_LT(difference(faces[i].D, taken ? D : Mat3{}), 1e-12);
    }
  }
}

TEST(ConstrainFaces, LetsEntriesShareAFaceWhenTheyHoldDifferentComponents) {
  const VoronoiBlock block;
  const auto faces =
      block.constrain({entry(3, {"+x"}, Condition::symmetric),
                       entry(5, {"x == max"}, PrescribedDisplacement{{std::nullopt, formula("t"), {}}})});
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (block.surface.pieces[i].N.x > 0.5) {
      EXPECT_LT(difference(faces[i].D, diagonal(1, 1, 0)), 1e-12);
      EXPECT_EQ(faces[i].parts.size(), 2U);
    }
}

TEST(ConstrainFaces, NamesBothEntriesOfAConflict) {
  const VoronoiBlock block;
  const std::string message = message_of([&] {
    block.constrain({entry(3, {"-y"}, Condition::symmetric), entry(7, {"+x"}, Condition::symmetric),
                     entry(9, {"x == max && Y > 0.5"}, PrescribedVelocity{{formula("1"), {}, {}}})});
  });
  EXPECT_TRUE(contains(message, "case.toml:9")) << message;
  EXPECT_TRUE(contains(message, "line 7")) << message;
  EXPECT_TRUE(contains(message, "boundary face at (1, ")) << message;
}

TEST(ConstrainFaces, RefusesSelectionsThatTakeNothing) {
  const VoronoiBlock block;
  const std::string message = message_of([&] { block.constrain({entry(4, {"x == max && Y > 2"}, Condition::fixed)}); });
  EXPECT_TRUE(contains(message, "case.toml:4:9")) << message;
  EXPECT_TRUE(contains(message, "takes no boundary face of body \"block\"")) << message;
  EXPECT_TRUE(contains(message, "+x")) << message;  // what there is instead
}

/// A corner of 120 degrees: symmetric on both oblique sides at once. A face has one normal, whatever the entry takes.
TEST(ConstrainFaces, UsesObliqueNormals) {
  Shape shape;
  shape.kind = PolygonShape{{{0, 0}, {2, 0}, {3, std::sqrt(3.0)}, {0, std::sqrt(3.0)}}, 0.0, 1.0};
  const Solid solid = build_solid(shape);
  const VoronoiBody body = voronoi_body(solid, {4, 3, 2}, 0.0, 1, nothing);
  const Surface surface = surface_of(solid, body.cells);
  const std::vector<BoundaryCondition> conditions{entry(3, {"edge1", "edge2"}, Condition::symmetric)};
  const auto faces = constrain_faces(surface, pointers(conditions));
  int oblique = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Vec3& N = surface.pieces[i].N;
    const bool first = N.y<-0.99, second = N.x> 0.5 && N.y < 0.0;
    oblique += second ? 1 : 0;
    EXPECT_LT(difference(faces[i].D, first || second ? outer(N, N) : Mat3{}), 1e-12);
  }
  EXPECT_GT(oblique, 0);
}

TEST(ConstrainParticles, UnitesCompatibleEntriesAtEdgesAndCorners) {
  const DelaunayBlock block;
  const auto list = block.constrain({entry(3, {"-x"}, Condition::symmetric), entry(4, {"-y"}, Condition::symmetric),
                                     entry(5, {"-z"}, Condition::fixed)});
  EXPECT_LT(difference(block.at(list, {0, 0.5, 0.5}).D, diagonal(1, 0, 0)), 1e-12);
  EXPECT_LT(difference(block.at(list, {0, 0, 0.5}).D, diagonal(1, 1, 0)), 1e-12);
  EXPECT_LT(difference(block.at(list, {0, 0, 0}).D, identity()), 1e-12);
  EXPECT_LT(difference(block.at(list, {0.5, 0.5, 0.5}).D, Mat3{}), 1e-12);
  EXPECT_LT(difference(block.at(list, {1, 1, 1}).D, Mat3{}), 1e-12);
}

/// One entry that takes two sides holds both normals at their common edge; antisymmetric ones then hold everything.
TEST(ConstrainParticles, OneEntryOverTwoSidesHoldsBothNormals) {
  const DelaunayBlock block;
  const auto symmetric = block.constrain({entry(3, {"-x", "-y"}, Condition::symmetric)});
  EXPECT_LT(difference(block.at(symmetric, {0, 0, 0.5}).D, diagonal(1, 1, 0)), 1e-12);
  EXPECT_LT(difference(block.at(symmetric, {0, 1, 0.5}).D, diagonal(1, 0, 0)), 1e-12);
  const auto antisymmetric = block.constrain({entry(3, {"+x", "+y"}, Condition::antisymmetric)});
  EXPECT_LT(difference(block.at(antisymmetric, {1, 1, 0.5}).D, identity()), 1e-12);
  EXPECT_LT(difference(block.at(antisymmetric, {1, 0.5, 0.5}).D, diagonal(0, 1, 1)), 1e-12);
}

/// A symmetric edge of 120 degrees: the particles on it keep to its line, and their constraint says so exactly.
TEST(ConstrainParticles, SpansObliqueNormals) {
  const Vec3 N1{0, -1, 0}, N2{std::sqrt(0.75), -0.5, 0};
  Surface surface;
  surface.body = "wedge";
  surface.side_names = {{"one"}, {"two"}};
  surface.known_names = {"one", "two"};
  surface.upper = {1, 1, 1};
  const std::vector<Vec3> X{{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  surface.pieces = {{{-0.3, 0, 0.3}, N1, 0, {0, 1, 2}}, {{0.2, 0.3, 0.3}, N2, 1, {0, 1, 3}}};
  for (const auto& conditions : {std::vector<BoundaryCondition>{entry(3, {"one", "two"}, Condition::symmetric)},
                                 std::vector<BoundaryCondition>{entry(3, {"one"}, Condition::symmetric),
                                                                entry(4, {"two"}, Condition::symmetric)}}) {
    const auto list = constrain_particles(surface, X, pointers(conditions), 1.0);
    EXPECT_LT(difference(list[0].D, diagonal(1, 1, 0)), 1e-12);
    EXPECT_LT(difference(list[2].D, outer(N1, N1)), 1e-12);
    EXPECT_LT(difference(list[3].D, outer(N2, N2)), 1e-12);
  }
}

/// Two moving entries meet at an edge: fine as long as the common component moves alike, an error with both lines
/// otherwise; the line is that of the entry that holds this component.
TEST(ConstrainParticles, ComparesMotionsWhereEntriesOverlap) {
  const DelaunayBlock block;
  const auto moving = [](const std::string& x, const std::string& y) {
    return PrescribedDisplacement{{formula(x), formula(y), std::nullopt}};
  };
  EXPECT_NO_THROW(block.constrain({entry(3, {"-x"}, moving("t*Y", "0")), entry(5, {"+y"}, moving("t", "X*t"))}));
  const std::string message = message_of([&] {
    block.constrain({entry(3, {"-z"}, Condition::symmetric), entry(4, {"-x"}, moving("t*Y", "0")),
                     entry(5, {"+y"}, moving("t*t", "X*t"))});
  });
  EXPECT_TRUE(contains(message, "case.toml:5")) << message;
  EXPECT_TRUE(contains(message, "line 4")) << message;
  EXPECT_TRUE(contains(message, "particle at (0, 1, ")) << message;
}

/// A velocity and the displacement that it integrates to agree.
TEST(ConstrainParticles, ComparesVelocitiesWithDisplacements) {
  const DelaunayBlock block;
  const PrescribedVelocity velocity{{formula("2*t"), {}, {}}};
  EXPECT_NO_THROW(block.constrain(
      {entry(3, {"-x"}, velocity), entry(4, {"-y"}, PrescribedDisplacement{{formula("t*t"), {}, {}}})}));
  EXPECT_THROW(
      block.constrain({entry(3, {"-x"}, velocity), entry(4, {"-y"}, PrescribedDisplacement{{formula("t"), {}, {}}})}),
      InputError);
}

/// The prescribed position of an oblique corner satisfies both entries: D u = sum M u_entry.
TEST(ConstrainParticles, PartsReproduceTheMotionOfEveryEntry) {
  const auto [surface, X, N1, N2] = Wedge();
  const std::vector<BoundaryCondition> conditions{
      entry(3, {"one"}, Condition::symmetric),
      entry(4, {"two"}, PrescribedDisplacement{{std::nullopt, formula("0.3*t"), std::nullopt}}),
      entry(5, {"two"}, PrescribedDisplacement{{std::nullopt, std::nullopt, formula("0.7*t")}})};
  auto list = constrain_particles(surface, X, pointers(conditions), 1.0);
  EXPECT_LT(difference(list[0].D, identity()), 1e-12);
  PrescribedMotion motion({X[0]}, {list[0]}, std::vector<Vec3>(1));
  motion.move_to(2.0);
  const Vec3 u = motion.positions()[0] - X[0];
  EXPECT_NEAR(dot(u, N1), 0.0, 1e-14);
  EXPECT_NEAR(u.y, 0.6, 1e-14);
  EXPECT_NEAR(u.z, 1.4, 1e-14);
}

/// A formula that takes particles but no whole triangle leaves symmetric conditions without a normal.
TEST(ConstrainParticles, RefuseNormalsWhereNoTriangleIsTaken) {
  const DelaunayBlock block;
  const std::string message =
      message_of([&] { block.constrain({entry(6, {"x == min && y == min"}, Condition::symmetric)}); });
  EXPECT_TRUE(contains(message, "case.toml:6")) << message;
  EXPECT_TRUE(contains(message, "normal")) << message;
  EXPECT_NO_THROW(block.constrain({entry(6, {"x == min && y == min"}, Condition::fixed)}));
}

/// At the rim of a formula a particle may have no triangle that is taken as a whole; the rest of the entry lends it a
/// normal.
TEST(ConstrainParticles, TakeTheNormalOfTheirSideAtTheRimOfAFormula) {
  Surface surface;
  surface.body = "plate";
  surface.upper = {2, 1, 1};
  const Vec3 up{0, 0, 1}, side{0, -1, 0};
  const std::vector<Vec3> X{{0, 0, 1}, {0.6, 0, 1}, {1.2, 0, 1}, {0, 1, 1}, {1.2, 1, 1}, {2, 0, 1}, {0, 0, 0}};
  surface.pieces = {{{}, up, -1, {0, 1, 3}},
                    {{}, up, -1, {1, 4, 3}},
                    {{}, up, -1, {1, 2, 3}},
                    {{}, up, -1, {2, 5, 4}},
                    {{}, side, -1, {0, 1, 6}}};
  const std::vector<BoundaryCondition> conditions{entry(3, {"z == max && X > 0.5"}, Condition::symmetric)};
  const auto list = constrain_particles(surface, X, pointers(conditions), 1.0);
  EXPECT_LT(difference(list[1].D, outer(up, up)), 1e-12);
  EXPECT_LT(difference(list[2].D, outer(up, up)), 1e-12);
  EXPECT_LT(difference(list[0].D, Mat3{}), 1e-12);
}

TEST(ConstrainParticles, RefusesSelectionsThatTakeNothing) {
  const DelaunayBlock block;
  const std::string message = message_of([&] { block.constrain({entry(4, {"X > 3"}, Condition::fixed)}); });
  EXPECT_TRUE(contains(message, "takes no boundary particle of body \"block\"")) << message;
  // Inner particles are no boundary.
  EXPECT_THROW(
      block.constrain({entry(4, {"X > 0.1 && X < 0.9 && Y > 0.1 && Y < 0.9 && Z > 0.1 && Z < 0.9"}, Condition::fixed)}),
      InputError);
}

TEST(LoadPieces, AddUpAndRefuseNothing) {
  const VoronoiBlock block;
  const std::vector<BoundaryCondition> conditions{entry(3, {"+x"}, NominalPressure{Formula(1.0)}),
                                                  entry(4, {"+x", "+y"}, NominalPressure{Formula(2.0)}),
                                                  entry(5, {"-z"}, Condition::fixed)};
  const auto loaded = load_pieces(block.surface, pointers(conditions));
  int first = 0, second = 0;
  for (const LoadedPiece& l : loaded) (l.condition == &conditions[0] ? first : second) += 1;
  EXPECT_EQ(second, 2 * first);
  const std::vector<BoundaryCondition> empty{entry(8, {"Y < -1"}, NominalPressure{Formula(1.0)})};
  EXPECT_TRUE(contains(message_of([&] { load_pieces(block.surface, pointers(empty)); }), "case.toml:8:9"));
}

}  // namespace
}  // namespace tessera::test
