#include <fmt/format.h>

#include "sample.hpp"

namespace tessera::test {
namespace {

/// A few conditions on a body of a given name.
std::vector<BoundaryCondition> conditions_for(const std::string& body) {
  std::vector<BoundaryCondition> list{
      condition({"-x"}, Condition::symmetric), condition({"-z"}, Condition::fixed),
      condition({"+z"}, PrescribedVelocity{{std::nullopt, std::nullopt, formula("-0.1")}}),
      condition({"+y"}, NominalTraction{formulas("100*t", "0", "200")})};
  for (BoundaryCondition& c : list) c.body = body;
  return list;
}

/// Bodies in one case do what each does alone, bitwise: positions, velocities, forces, stresses.
TEST(SeveralBodies, MoveAsEachDoesAlone) {
  for (Method method : all_methods) {
    Case one = cube_case(method, {3, 3, 3}, 0.2), two = one, both = one;
    both.materials = {rubber(1e6), rubber(3e6)};
    both.materials[1].viscosity = {0.1, 0.1};
    one.materials = two.materials = both.materials;
    BodySpec left = box_body(method, "left", {0, 0, 0}, {1, 1, 1}, {3, 3, 3}, 0.2);
    BodySpec right = box_body(method, "right", {2, 0, 0}, {3, 1, 1}, {4, 3, 2}, 0.15);
    right.material = 1;
    one.bodies = {left};
    two.bodies = {right};
    both.bodies = {left, right};
    one.boundary = conditions_for("left");
    two.boundary = conditions_for("right");
    both.boundary = one.boundary;
    both.boundary.insert(both.boundary.end(), two.boundary.begin(), two.boundary.end());
    Running a(one), b(two), ab(both);
    std::vector<Snapshot> shots;
    for (Running* run : {&a, &b, &ab}) {
      run->advance(20);
      run->engine.prepare();
      shots.push_back(run->engine.snapshot());
    }
    const std::size_t n = shots[0].position.size();
    ASSERT_EQ(shots[2].position.size(), n + shots[1].position.size());
    for (std::size_t i = 0; i < shots[2].position.size(); ++i) {
      const Snapshot& own = i < n ? shots[0] : shots[1];
      const std::size_t k = i < n ? i : i - n;
      ASSERT_EQ(shots[2].position[i], own.position[k]) << name_of(method) << i;
      ASSERT_EQ(shots[2].velocity[i], own.velocity[k]);
      ASSERT_EQ(shots[2].force[i], own.force[k]);
      ASSERT_EQ(shots[2].internal_force[i], own.internal_force[k]);
      ASSERT_EQ(shots[2].first_piola_kirchhoff[i], own.first_piola_kirchhoff[k]);
      EXPECT_EQ(shots[2].body[i], i < n ? 0 : 1);
      EXPECT_EQ(shots[2].material[i], i < n ? 0 : 1);
    }
    std::vector<Vec3> reactions = a.engine.reactions();
    reactions.insert(reactions.end(), b.engine.reactions().begin(), b.engine.reactions().end());
    EXPECT_EQ(ab.engine.reactions(), reactions);
  }
}

/// What only the mesher heeds is refused where particles come from a lattice.
TEST(MesherWishes, AreRefusedWithoutMesher) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    Case c = cube_case(method, {3, 3, 3}, 0.0);
    c.bodies[0].particles.mesher.size = formula("0.1 + X");
    try {
      build_model(c);
      FAIL() << name_of(method);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("size without arrangement"), std::string::npos) << error.what();
    }
  }
}

TEST(SeveralBodies, MustNotOverlap) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    Case c = cube_case(method);
    c.bodies.push_back(box_body(method, "other", {0.9, 0, 0}, {2, 1, 1}, {2, 2, 2}, 0.0));
    c.bodies.back().origin.line = 21;
    const std::string message = message_of<InputError>([&] { build_model(c); });
    EXPECT_TRUE(contains(message, "case.toml:21")) << message;
    EXPECT_TRUE(contains(message, "body \"other\" overlaps body \"cube\" at (0.95, 0.5, 0.5) m")) << message;
    // Bodies that touch share no volume.
    c.bodies[1] = box_body(method, "other", {1, 0, 0}, {2, 1, 1}, {2, 2, 2}, 0.0);
    EXPECT_NO_THROW(build_model(c));
  }
}

/// A box within the arm of an L meets its bounding box but not the body.
TEST(SeveralBodies, MayLieInEachOthersBoundingBox) {
  Case c = cube_case(Method::consistent);
  c.bodies[0].shape->kind = PolygonShape{{{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 10}, {0, 10}}, 0.0, 3.0};
  std::get<LatticeSpec>(c.bodies[0].particles.source).counts = std::array<int, 3>{6, 10, 3};
  c.bodies.push_back(box_body(Method::consistent, "inner", {3.5, 3.5, 0}, {6, 10, 3}, {2, 2, 2}, 0.0));
  EXPECT_NO_THROW(build_model(c));
  c.bodies[1] = box_body(Method::consistent, "inner", {2.9, 3.5, 0}, {6, 10, 3}, {2, 2, 2}, 0.0);
  EXPECT_THROW(build_model(c), InputError);
}

/// Plane strain is the slab one cell thick with symmetric faces, bitwise, and nothing moves across.
TEST(TwoDimensions, AreASymmetricSlab) {
  for (Method method : {Method::delaunay, Method::consistent, Method::quasi_static}) {
    Case slab = cube_case(method);
    slab.bodies = {box_body(method, "plate", {0, 0, 0}, {4, 3, 1}, {4, 3, 1}, 0.0)};
    slab.boundary = {condition({"-x"}, Condition::fixed),
                     condition({"+x"}, NominalTraction{formulas("0", "3e4*t", "0")})};
    slab.gravity = {0, -9.81, 0};
    Case plane = slab;
    plane.method.dimension = 2;
    // Layers across the plate are not the user's business.
    std::get<LatticeSpec>(plane.bodies[0].particles.source).counts->at(2) = 7;
    slab.boundary.push_back(condition({"-z", "+z"}, Condition::symmetric));
    if (method == Method::delaunay || method == Method::consistent || method == Method::quasi_static)
      slab.boundary[0].where.items = plane.boundary[0].where.items;
    Running a(slab), b(plane);
    a.finish();
    b.finish();
    const Snapshot thick = a.engine.snapshot(), flat = b.engine.snapshot();
    ASSERT_EQ(thick.position.size(), flat.position.size());
    EXPECT_EQ(thick.position, flat.position) << name_of(method);
    EXPECT_EQ(thick.velocity, flat.velocity);
    double moved = 0.0;
    for (std::size_t i = 0; i < flat.position.size(); ++i) {
      EXPECT_NEAR(flat.position[i].z, flat.reference_position[i].z, 1e-14);
      EXPECT_NEAR(flat.deformation_gradient[i](2, 2), 1.0, 1e-13);
      moved = std::max(moved, std::abs(flat.position[i].y - flat.reference_position[i].y));
    }
    EXPECT_GT(moved, 1e-4);
  }
}

/// Across the slab nothing tells how F varies. In two dimensions it does not vary there, so nothing is missed.
TEST(TwoDimensions, MissNothingAcrossTheSlab) {
  Case c = cube_case(Method::consistent, {4, 3, 1}, 0.2);
  c.method.dimension = 2;
  c.method.integration = Integration::cell;
  const Model model = build_model(c);
  EXPECT_EQ(model.system.gradients->unresolved, 0);
  for (const std::string& note : model.notes) EXPECT_FALSE(contains(note, "cell integration")) << note;
}

/// In three dimensions F may vary across a single layer, which is said.
TEST(OneLayer, IsTakenAsConstantAcrossByCellIntegration) {
  Case c = cube_case(Method::consistent, {4, 3, 1}, 0.0);
  c.method.integration = Integration::cell;
  c.boundary = {condition({"-z", "+z"}, Condition::symmetric)};
  const Model model = build_model(c);
  EXPECT_EQ(model.system.gradients->unresolved, 12);
  ASSERT_FALSE(model.notes.empty());
  EXPECT_TRUE(contains(model.notes.back(), "cell integration: 12 of 12 cells")) << model.notes.back();
}

/// Irregular points keep to their plane.
TEST(TwoDimensions, KeepJitteredPointsInOnePlane) {
  for (Method method : {Method::delaunay, Method::consistent}) {
    Case c = cube_case(method);
    c.method.dimension = 2;
    c.bodies = {box_body(method, "plate", {0, 0, 0}, {4, 3, 1}, {6, 5, 1}, 0.25)};
    c.initial = {initial_velocity(formulas("0.5*Y", "0", "0"))};
    Running run(c);
    run.finish();
    const Snapshot shot = run.engine.snapshot();
    for (std::size_t i = 0; i < shot.position.size(); ++i)
      EXPECT_NEAR(shot.position[i].z, shot.reference_position[i].z, 1e-12) << name_of(method);
  }
}

/// One particle whose faces are all prescribed follows them: F is the walls' gradient.
TEST(SmallBodies, OfOneParticleFollowTheirWalls) {
  for (Method method : {Method::consistent, Method::variational, Method::quasi_static}) {
    Case c = cube_case(method, {1, 1, 1}, 0.0);
    c.boundary = {condition({"-x", "+x", "-y", "+y", "-z", "+z"},
                            PrescribedDisplacement{components(formulas("2*t*X", "t*Z", "0"))})};
    c.time.step = AutoStep{};
    Running run(c);
    run.finish();
    const Mat3 F = run.engine.snapshot().deformation_gradient[0];
    EXPECT_NEAR(F(0, 0), 1.1, 1e-9) << name_of(method);
    EXPECT_NEAR(F(1, 2), 0.05, 1e-9);
  }
}

TEST(SmallBodies, OfOneFreeParticleAreRefused) {
  const Case c = cube_case(Method::consistent, {1, 1, 1}, 0.0);
  const std::string message = message_of<GeometryError>([&] { build_model(c); });
  EXPECT_TRUE(contains(message, "particle 0 at (0.5, 0.5, 0.5)")) << message;
}

/// A slab one particle thick with free faces cannot know how it stretches across: the error says what to do. With
/// symmetric faces it is plane strain and fine.
TEST(SmallBodies, OneParticleThickNeedHeldFaces) {
  for (Method method : {Method::consistent, Method::variational, Method::quasi_static}) {
    Case c = cube_case(method, {5, 4, 1}, 0.0);
    const std::string message = message_of<GeometryError>([&] {
      const Model model = build_model(c);
      require(model.identities);
    });
    EXPECT_TRUE(contains(message, method == Method::consistent ? "at least two layers" : "")) << message;
    EXPECT_NE(message, "") << name_of(method);
    c.boundary = {condition({"-z", "+z"}, Condition::symmetric)};
    EXPECT_NO_THROW(require(build_model(c).identities)) << name_of(method);
  }
}

/// Errors call bodies and particles as the user does, not by their places in memory.
TEST(SmallBodies, ThatCannotFollowAreNamedWithParticleAndPosition) {
  Case c = cube_case(Method::consistent);
  c.bodies.push_back(box_body(Method::consistent, "slab", {2, 0, 0}, {3, 1, 1}, {5, 4, 1}, 0.0));
  const std::vector<Vec3> X =
      place_particles(c.bodies[1].particles, build_solid(*c.bodies[1].shape), Placement::cell_centres).points;
  const std::string message = message_of<GeometryError>([&] { build_model(c); });
  EXPECT_TRUE(contains(message, "(body \"slab\")")) << message;
  const std::size_t a = std::stoul(message.substr(message.find("particle ") + 9));
  ASSERT_LT(a, X.size()) << message;
  EXPECT_TRUE(contains(message, fmt::format("particle {} at ({:g}, {:g}, {:g}) m", a, X[a].x, X[a].y, X[a].z)))
      << message;
}

/// A traction along a held component would be lost without a word.
TEST(LoadsOnHeldComponents, AreRefused) {
  Case c = cube_case(Method::consistent);
  c.boundary = {condition({"+x"}, Condition::symmetric), condition({"+x"}, NominalTraction{formulas("1", "0", "0")})};
  c.boundary[1].origin.line = 14;
  const std::string message = message_of<InputError>([&] { build_model(c); });
  EXPECT_TRUE(contains(message, "case.toml:14")) << message;
  EXPECT_TRUE(contains(message, "line 10")) << message;
  c.boundary[1].kind = NominalTraction{formulas("0", "1", "0")};
  EXPECT_NO_THROW(build_model(c));
}

/// Snapshots are in the user's order: lattice points row by row, x fastest, whatever the order in memory.
TEST(Snapshots, KeepTheOrderOfTheLattice) {
  for (Method method : all_methods) {
    const Case c = cube_case(method, {4, 3, 2}, 0.0);
    Running run(c);
    run.engine.prepare();
    const Snapshot shot = run.engine.snapshot();
    for (std::size_t i = 1; i < shot.position.size(); ++i) {
      const Vec3 &p = shot.reference_position[i - 1], &q = shot.reference_position[i];
      EXPECT_TRUE(std::tie(p.z, p.y, p.x) < std::tie(q.z, q.y, q.x)) << name_of(method) << i;
    }
  }
}

/// internal + contact + external (+ reactions of held particles) = total; at rest all vanish.
TEST(Snapshots, SplitTheForces) {
  for (Method method : all_methods) {
    Case c = cube_case(method);
    c.gravity = {0, 0, -9.81};
    c.initial = {{"", formulas("0.05*X*Y", "0.02*Z", "0"), formulas("1", "0", "0"), {}}};
    c.boundary = {condition({"+z"}, NominalTraction{formulas("0", "1e4", "0")})};
    Running run(c);
    run.engine.prepare();
    const Snapshot shot = run.engine.snapshot();
    Vec3 external;
    for (std::size_t i = 0; i < shot.force.size(); ++i) {
      const Vec3 sum = shot.internal_force[i] + shot.contact_force[i] + shot.external_force[i];
      EXPECT_LT(norm(sum - shot.force[i]), 1e-9) << name_of(method);
      external += shot.external_force[i];
    }
    EXPECT_LT(norm(external - Vec3{0, 1e4, -9810}), 1e-8);
  }
}

}  // namespace
}  // namespace tessera::test
