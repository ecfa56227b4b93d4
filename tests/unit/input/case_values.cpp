#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "sample.hpp"

namespace tessera {
namespace {

TEST(Case, HoldsWhatTheFileSays) {
  const Case c = sample::read(sample::text);
  EXPECT_EQ(c.title, "Punch");
  EXPECT_EQ(c.file, "dir/case.toml");
  EXPECT_EQ(c.method.formulation, Formulation::voronoi);
  EXPECT_EQ(c.method.boundary, BoundaryTreatment::variational);
  EXPECT_EQ(c.method.dimension, 3);
  EXPECT_EQ(c.gravity, (Vec3{0.0, 0.0, -9.81}));
  ASSERT_EQ(c.bodies.size(), 1U);
  EXPECT_EQ(c.bodies[0].name, "block");
  EXPECT_EQ(c.bodies[0].material, 0);
  const auto& box = std::get<BoxShape>(c.bodies[0].shape->kind);
  EXPECT_EQ(box.min, (Vec3{0.0, 0.0, 0.0}));
  EXPECT_EQ(box.max, (Vec3{1.0, 0.5, 0.1}));
  const auto& lattice = std::get<LatticeSpec>(c.bodies[0].particles.source);
  EXPECT_EQ(*lattice.counts, (std::array<int, 3>{21, 11, 3}));
  EXPECT_FALSE(lattice.spacing);
  EXPECT_EQ(lattice.jitter, 0.25);
  EXPECT_EQ(lattice.seed, 7U);
}

TEST(Case, HoldsMaterials) {
  const Case c = sample::read(sample::text);
  ASSERT_EQ(c.materials.size(), 1U);
  const Material& m = c.materials[0];
  EXPECT_EQ(m.name, "rubber");
  EXPECT_EQ(m.young, 1e6);
  EXPECT_EQ(m.poisson, 0.45);
  EXPECT_EQ(m.density, 1000.0);
  EXPECT_EQ(m.contact.normal, 0.5);
  EXPECT_EQ(m.contact.tangential, 2.0);
  EXPECT_EQ(m.viscosity.linear, 0.1);
  EXPECT_EQ(m.viscosity.quadratic, 0.2);
  const auto& law = std::get<NeoHookean>(m.law);
  EXPECT_NEAR(law.mu, 1e6 / 2.9, 1e-6);
  EXPECT_NEAR(law.lambda, 0.45e6 / (1.45 * 0.1), 1e-6);
}

TEST(Case, HoldsLoads) {
  const Case c = sample::read(sample::text);
  const Vec3 X{6.0, 0.0, 0.0};
  ASSERT_EQ(c.initial.size(), 1U);
  EXPECT_EQ(c.initial[0].body, "");
  EXPECT_EQ(evaluate(c.initial[0].displacement, 0.0, X), (Vec3{1e-4 * 6.0, 0.0, 0.002}));
  EXPECT_EQ(evaluate(c.initial[0].velocity, 0.0, X), (Vec3{0.0, 0.0, 10.0}));
  ASSERT_EQ(c.boundary.size(), 4U);
  const auto& motion = std::get<PrescribedDisplacement>(c.boundary[0].kind).components;
  EXPECT_TRUE(motion[0]->is_constant());
  EXPECT_DOUBLE_EQ((*motion[1])(3.0, X), -0.3);
  EXPECT_FALSE(motion[2]);
  EXPECT_EQ(c.boundary[0].where.items, (std::vector<std::string>{"y == max && X > 1/3"}));
  EXPECT_EQ(c.boundary[0].where.origin.line, 22);
  EXPECT_EQ(c.boundary[0].where.origin.column, 9);
  EXPECT_EQ(std::get<Condition>(c.boundary[1].kind), Condition::symmetric);
  EXPECT_EQ(c.boundary[1].where.items, (std::vector<std::string>{"-x", "+x"}));
  EXPECT_EQ(evaluate(std::get<NominalTraction>(c.boundary[2].kind).components, 2.0, X), (Vec3{1e3, 4.0, 0.0}));
  EXPECT_EQ(std::get<NominalPressure>(c.boundary[3].kind).pressure(0.0, X), 2e5);
}

TEST(Case, HoldsLoadsOnFacesOfAnyDirection) {
  const auto kind_of = [](const std::string& entry) {
    return sample::read(sample::with("pressure = \"2 bar\"", entry)).boundary[3].kind;
  };
  const Vec3 X{1, 2, 3}, N{0, 0.6, 0.8};
  const auto rotation = kind_of(
      "rotation = { axis = [0, 3, 4], point = [\"1 cm\", 0, 0], angle = \"180 deg\" }\ndisplacement = [0, \"t\", 1]");
  EXPECT_LT(norm(std::get<PrescribedRotation>(rotation).axis - N), 1e-15);
  EXPECT_EQ(std::get<PrescribedRotation>(rotation).point, (Vec3{0.01, 0, 0}));
  EXPECT_DOUBLE_EQ(std::get<PrescribedRotation>(rotation).angle(0.0, X), 3.14159265358979323846);
  EXPECT_EQ(evaluate(std::get<PrescribedRotation>(rotation).displacement, 5.0, X), (Vec3{0, 5, 1}));
  EXPECT_EQ(std::get<PrescribedRotation>(kind_of("rotation = { angle = \"t\" }")).axis, (Vec3{0, 0, 1}));
  EXPECT_EQ(std::get<NormalDisplacement>(kind_of("normal_displacement = \"-2 mm\"")).value(0.0, X), -0.002);
  EXPECT_EQ(std::get<TangentialDisplacement>(kind_of("tangential_displacement = [0, \"X\", 1]")).components[1](0.0, X),
            1.0);
  EXPECT_EQ(std::get<FollowingPressure>(kind_of("following_pressure = \"10*ny\"")).pressure(0.0, X, N), 6.0);
  const auto stress = kind_of("stress = [[\"1 kPa\", 2, 3], [4, \"t*nz\", 6], [7, 8, 9]]");
  EXPECT_EQ(evaluate(std::get<NominalStress>(stress).rows[0], 0.0, X), (Vec3{1000, 2, 3}));
  EXPECT_EQ(evaluate(std::get<NominalStress>(stress).rows[1], 10.0, X, N), (Vec3{4, 8, 6}));
}

TEST(Case, HoldsTimeAndOutput) {
  const Case c = sample::read(sample::text);
  EXPECT_EQ(c.time.end, 1.5);
  EXPECT_TRUE(std::holds_alternative<AutoSpectralStep>(c.time.step));
  EXPECT_EQ(c.time.safety, 0.8);
  EXPECT_EQ(c.time.damping, 2.0);
  EXPECT_EQ(c.time.origin.line, 37);
  EXPECT_EQ(c.output.fields.format, FieldFormat::csv);
  EXPECT_EQ(c.output.fields.every, 0.05);
  EXPECT_EQ(c.output.fields.quantities, (std::vector<std::string>{"displacement", "stress"}));
  EXPECT_TRUE(c.output.fields.cells);
  EXPECT_EQ(c.output.history.every, 0.001);
  EXPECT_EQ(c.output.checkpoint.every_wall, 60.0);
  EXPECT_FALSE(c.output.checkpoint.every_time);
  ASSERT_EQ(c.probes.size(), 3U);
  EXPECT_EQ(c.probes[0].kind, ProbeKind::reaction);
  EXPECT_EQ(c.probes[0].where->items, (std::vector<std::string>{"y == max"}));
  EXPECT_EQ(*c.probes[1].at, (Vec3{1.0, 0.2, 0.0}));
  EXPECT_EQ(c.probes[2].quantity, "von_mises");
  EXPECT_FALSE(c.probes[2].where);
  ASSERT_EQ(c.references.size(), 1U);
  EXPECT_EQ(c.references[0].name, "exact");
}

const std::string smallest = R"(
[[body]]
shape = { box = { min = [0, 0, 0], max = [1, 1, 1] } }
particles = { spacing = "10 cm" }
material = "m"
[[material]]
name = "m"
young = 1e6
poisson = 0
density = 1000
[time]
end = 0
)";

TEST(Case, FillsInDefaults) {
  const Case c = sample::read(smallest);
  EXPECT_EQ(c.method.formulation, Formulation::voronoi);
  EXPECT_EQ(c.method.boundary, BoundaryTreatment::consistent);
  EXPECT_EQ(c.bodies[0].name, "body");
  const auto& lattice = std::get<LatticeSpec>(c.bodies[0].particles.source);
  EXPECT_EQ(*lattice.spacing, 0.1);
  EXPECT_EQ(lattice.jitter, 0.0);
  EXPECT_EQ(lattice.seed, 1U);
  EXPECT_EQ(c.materials[0].model, "neo-hookean");
  EXPECT_EQ(c.materials[0].contact.normal, 1.0);
  EXPECT_EQ(c.materials[0].viscosity.linear, 0.0);
  EXPECT_TRUE(std::holds_alternative<AutoSpectralStep>(c.time.step));
  EXPECT_EQ(c.time.safety, 0.8);
  EXPECT_FALSE(c.time.mass_scaling);
  EXPECT_EQ(c.output.fields.format, FieldFormat::vtkhdf);
  EXPECT_EQ(c.output.fields.precision, FieldPrecision::mixed);
  EXPECT_FALSE(c.output.fields.every);
  EXPECT_FALSE(c.output.history.every);
  EXPECT_FALSE(c.output.checkpoint.every_wall);
  EXPECT_TRUE(c.boundary.empty());
  EXPECT_EQ(c.gravity, Vec3{});
}

TEST(Case, IrregularArrangements) {
  const auto particles = [](const std::string& text) {
    return sample::read(sample::with("{ lattice = \"cubic\", counts = [21, 11, 3], jitter = 0.25, seed = 7 }", text))
        .bodies[0]
        .particles;
  };
  const auto random =
      std::get<RandomSpec>(particles("{ arrangement = \"random\", spacing = \"5 mm\", seed = 3 }").source);
  EXPECT_EQ(*random.amount.spacing, 0.005);
  EXPECT_EQ(random.seed, 3U);
  const auto relaxed = std::get<RelaxedSpec>(
      particles("{ arrangement = \"relaxed\", count = 500, size = \"1 + X\", iterations = 7, tolerance = 0.1 }")
          .source);
  EXPECT_EQ(*relaxed.amount.count, 500);
  EXPECT_FALSE(relaxed.amount.spacing);
  EXPECT_EQ(relaxed.iterations, 7);
  EXPECT_EQ(relaxed.tolerance, 0.1);
  EXPECT_EQ((*relaxed.size)(0.0, {2, 0, 0}), 3.0);
  const auto lattice = std::get<LatticeSpec>(particles("{ lattice = \"hcp\", count = 500 }").source);
  EXPECT_EQ(lattice.kind, LatticeKind::hcp);
  EXPECT_EQ(*lattice.count, 500);
}

TEST(Case, TakesEveryKindOfShape) {
  const std::string line = "shape = { box = { min = [0, 0, 0], max = [\"1 m\", \"50 cm\", 0.1] } }";
  const Case c = sample::read(sample::with(line, R"(shape = { name = "L", difference = [
      { box = { min = [0, 0, 0], max = [1, 1, 1] } },
      { union = [ { name = "hole", box = { min = [0, 0, 0], max = [0.5, 0.5, 1] } },
                  { polygon = { points = [[0, 0], ["1 cm", 0], [0, 0.01]], thickness = "2 mm", base = -1 } } ] } ] })"));
  const auto& difference = std::get<DifferenceShape>(c.bodies[0].shape->kind);
  EXPECT_EQ(c.bodies[0].shape->name, "L");
  ASSERT_EQ(difference.parts.size(), 2U);
  const auto& parts = std::get<UnionShape>(difference.parts[1].kind).parts;
  EXPECT_EQ(parts[0].name, "hole");
  EXPECT_EQ(parts[0].origin.line, 9);
  EXPECT_EQ(parts[0].origin.key, "body.0.shape.difference.1.union.0");
  const auto& polygon = std::get<PolygonShape>(parts[1].kind);
  ASSERT_EQ(polygon.points.size(), 3U);
  EXPECT_EQ(polygon.points[1], (std::array<double, 2>{0.01, 0.0}));
  EXPECT_EQ(polygon.thickness, 0.002);
  EXPECT_EQ(polygon.base, -1.0);
}

TEST(Case, FindsFilesBesideTheCase) {
  const std::string line = "particles = { lattice = \"cubic\", counts = [21, 11, 3], jitter = 0.25, seed = 7 }";
  const Case points = sample::read(sample::with(line, "particles = { file = \"points/a.csv\" }"));
  const std::string beside = std::filesystem::absolute("dir/points/a.csv").string();
  EXPECT_EQ(std::get<PointFileSpec>(points.bodies[0].particles.source).path, beside);
  const Case mesh =
      sample::read(sample::with(line, "particles = { mesh = \"/tmp/a.msh\" }"), {"method.formulation=delaunay"});
  EXPECT_EQ(std::get<MeshFileSpec>(mesh.bodies[0].particles.source).path, "/tmp/a.msh");
}

TEST(Case, TakesAFixedStepAndSimulatedCheckpoints) {
  const Case c = sample::read(sample::text, {"time.step=2 us", "time.force=true", "output.checkpoint.every=0.5"});
  EXPECT_EQ(std::get<FixedStep>(c.time.step).dt, 2e-6);
  EXPECT_TRUE(std::get<FixedStep>(c.time.step).force);
  EXPECT_EQ(c.output.checkpoint.every_time, 0.5);
  EXPECT_FALSE(c.output.checkpoint.every_wall);
}

TEST(Case, TakesTheDefaultThatBelongsToTheStep) {
  EXPECT_EQ(sample::read(smallest, {"time.step=auto"}).time.safety, 0.3);
  EXPECT_EQ(sample::read(smallest, {"time.step=auto-spectral"}).time.safety, 0.8);
  EXPECT_EQ(sample::read(smallest, {"time.step=auto", "time.safety=0.5"}).time.safety, 0.5);
}

TEST(Case, ScalesMassBesideSpectralStepsOnly) {
  EXPECT_EQ(sample::read(smallest, {"time.mass_scaling=2 us"}).time.mass_scaling->step, 2e-6);
  EXPECT_THROW(sample::read(smallest, {"time.mass_scaling=2 us", "time.step=auto"}), InputError);
  EXPECT_THROW(sample::read(smallest, {"time.mass_scaling=0"}), InputError);
}

TEST(Case, TellsWhichKeysHaveNoEffect) {
  const CaseFile file = read_case_text(sample::text, "case.toml", {"time.step=1e-6", "method.formulation=delaunay"});
  ASSERT_EQ(file.unused.size(), 2U);
  EXPECT_EQ(file.unused[0], "case.toml:4:12: method.boundary: only has an effect with formulation = \"voronoi\"");
  EXPECT_EQ(file.unused[1],
            "case.toml:38:10: time.safety: only has an effect with step = \"auto\" or step = \"auto-spectral\"");
  EXPECT_TRUE(read_case_text(sample::text, "case.toml", {}).unused.empty());
}

const std::string flat = R"(
[method]
dimension = 2
[[body]]
shape = { polygon = { points = [[0, 0], [2, 0], [2, 1], [0, 1]] } }
particles = { counts = [20, 10] }
material = "m"
[[material]]
name = "m"
young = 1e6
poisson = 0.3
density = 1000
[[initial]]
velocity = ["Y", "-X"]
[[boundary]]
where = "edge4"
displacement = [0, "free"]
[[boundary]]
where = "edge2"
traction = ["1 kPa", 0]
[gravity]
acceleration = [0, -9.81]
[time]
end = 1
[[probe]]
name = "corner"
type = "point"
at = [2, 1]
)";

TEST(Case, TakesTwoComponentsInTwoDimensions) {
  const Case c = sample::read(flat);
  EXPECT_EQ(c.method.dimension, 2);
  const auto& polygon = std::get<PolygonShape>(c.bodies[0].shape->kind);
  EXPECT_EQ(polygon.base, 0.0);
  EXPECT_EQ(polygon.thickness, 1.0);
  EXPECT_EQ(*std::get<LatticeSpec>(c.bodies[0].particles.source).counts, (std::array<int, 3>{20, 10, 1}));
  EXPECT_EQ(evaluate(c.initial[0].velocity, 0.0, {3.0, 4.0, 5.0}), (Vec3{4.0, -3.0, 0.0}));
  EXPECT_FALSE(std::get<PrescribedDisplacement>(c.boundary[0].kind).components[2]);
  EXPECT_EQ(evaluate(std::get<NominalTraction>(c.boundary[1].kind).components, 0.0, {}), (Vec3{1e3, 0.0, 0.0}));
  EXPECT_EQ(c.gravity, (Vec3{0.0, -9.81, 0.0}));
  EXPECT_EQ(*c.probes[0].at, (Vec3{2.0, 1.0, 0.5}));
  std::string box = flat;
  const std::string polygon_text = "polygon = { points = [[0, 0], [2, 0], [2, 1], [0, 1]] }";
  box.replace(box.find(polygon_text), polygon_text.size(), "box = { min = [0, 0], max = [2, 1] }");
  const Case b = sample::read(box);
  EXPECT_EQ(std::get<BoxShape>(b.bodies[0].shape->kind).min, (Vec3{0.0, 0.0, 0.0}));
  EXPECT_EQ(std::get<BoxShape>(b.bodies[0].shape->kind).max, (Vec3{2.0, 1.0, 1.0}));
}

Case with_shape(const std::string& shape) {
  const std::string line = "shape = { box = { min = [0, 0, 0], max = [\"1 m\", \"50 cm\", 0.1] } }";
  return sample::read(sample::with(line, "shape = " + shape));
}

TEST(Case, TakesCurvedShapes) {
  const Case c = with_shape(R"({ intersection = [
      { cylinder = { from = [0, 0, 0], to = [0, 0, "1 cm"], radius = "2 mm", tolerance = "1 um" } },
      { cone = { from = [0, 0, 0], to = [1, 0, 0], radius = 3 } }, { sphere = { center = [1, 2, 3], radius = 4 } },
      { ellipsoid = { semi_axes = [1, 2, 3] } },
      { torus = { axis = [1, 0, 0], radius = 2, tube_radius = 1 } } ] })");
  const auto& parts = std::get<IntersectionShape>(c.bodies[0].shape->kind).parts;
  ASSERT_EQ(parts.size(), 5U);
  const auto& cylinder = std::get<ConeShape>(parts[0].kind);
  EXPECT_EQ(cylinder.to, (Vec3{0, 0, 0.01}));
  EXPECT_EQ(cylinder.radii, (std::array<double, 2>{2e-3, 2e-3}));
  EXPECT_EQ(cylinder.tolerance, 1e-6);
  EXPECT_EQ(std::get<ConeShape>(parts[1].kind).radii, (std::array<double, 2>{3.0, 0.0}));
  EXPECT_EQ(std::get<EllipsoidShape>(parts[2].kind).center, (Vec3{1, 2, 3}));
  EXPECT_EQ(std::get<EllipsoidShape>(parts[2].kind).semi_axes, (Vec3{4, 4, 4}));
  EXPECT_FALSE(std::get<EllipsoidShape>(parts[3].kind).tolerance);
  EXPECT_EQ(std::get<TorusShape>(parts[4].kind).axis, (Vec3{1, 0, 0}));
}

TEST(Case, TakesMovesOfShapes) {
  const Case c = with_shape(
      R"({ box = { min = [0, 0, 0], max = [1, 1, 1] }, scale = 2, rotate = { angle = "90 deg", about = [1, 0, 0] }, translate = ["1 mm", 0, 0] })");
  const ShapeMove& move = c.bodies[0].shape->move;
  EXPECT_EQ(move.scale, (Vec3{2, 2, 2}));
  EXPECT_EQ(move.rotation->axis, (Vec3{0, 0, 1}));
  EXPECT_EQ(move.rotation->angle, 90.0);
  EXPECT_EQ(move.translation, (Vec3{1e-3, 0, 0}));
  const auto angle = [](const std::string& text) {
    return with_shape("{ sphere = { radius = 1 }, rotate = { angle = " + text + " } }")
        .bodies[0]
        .shape->move.rotation->angle;
  };
  EXPECT_EQ(angle("30"), 30.0);
  EXPECT_EQ(angle("\"30\""), 30.0);
  EXPECT_NEAR(angle("\"0.5 rad\""), 28.647889756541160, 1e-14);
  for (const double whole : {1.0, 29.0, 57.0, 180.0, 270.0, -90.0, 360.0})
    EXPECT_EQ(angle(fmt::format("\"{} deg\"", whole)), whole);
}

TEST(Integration, DefaultIsTheMostAccurateThatGoesWithTheMethod) {
  const auto with = [](std::vector<std::string> overrides) {
    return sample::read(smallest, overrides).method.integration;
  };
  EXPECT_EQ(with({}), Integration::second_order);
  EXPECT_EQ(with({"method.boundary=variational"}), Integration::cell);
  EXPECT_EQ(with({"method.boundary=quasi-static"}), Integration::nodal);
  EXPECT_EQ(with({"method.formulation=delaunay"}), Integration::cell);
  EXPECT_EQ(with({"method.formulation=delaunay", "method.boundary=quasi-static"}), Integration::cell);
  EXPECT_EQ(with({"method.volumetric=averaged"}), Integration::nodal);
  EXPECT_EQ(with({"method.volumetric=averaged", "method.formulation=delaunay"}), Integration::nodal);
  EXPECT_EQ(with({"method.integration=nodal"}), Integration::nodal);
}

TEST(EffectiveCase, ReadsBackToTheSameCase) {
  const std::vector<std::string> texts = {
      sample::text,
      smallest,
      flat,
      sample::with("particles = { lattice = \"cubic\", counts = [21, 11, 3], jitter = 0.25, seed = 7 }",
                   "particles = { file = \"a b/\\\"c\\\".csv\" }"),
      sample::with("young = \"1 MPa\"", "young = 123456.78901234567"),
      sample::with("poisson = 0.45", "poisson = 1e-30"),
      sample::with("shape = { box = { min = [0, 0, 0], max = [\"1 m\", \"50 cm\", 0.1] } }",
                   "shape = { sphere = { radius = 1 }, scale = 2, rotate = { angle = \"0.1 rad\" } }")};
  for (const std::string& text : texts) {
    const Case first = sample::read(text);
    // Elsewhere, so that file names must not depend on where the file lies.
    const CaseFile second = read_case_text(first.effective, "results/case.toml", {});
    EXPECT_EQ(second.value.effective, first.effective);
    EXPECT_TRUE(second.unused.empty());
    EXPECT_EQ(second.value.materials[0].young, first.materials[0].young);
    EXPECT_EQ(second.value.time.end, first.time.end);
    EXPECT_EQ(second.value.boundary.size(), first.boundary.size());
    EXPECT_EQ(second.value.probes.size(), first.probes.size());
  }
}

TEST(EffectiveCase, ShowsDefaults) {
  const std::string effective = sample::read(smallest).effective;
  for (const char* part : {"formulation = \"voronoi\"", "boundary = \"consistent\"", "safety = 0.8",
                           "contact = { normal = 1, tangential = 1 }", "spacing = 0.1", "seed = 1",
                           "format = \"vtkhdf\"", "acceleration = [0, 0, 0]"})
    EXPECT_NE(effective.find(part), std::string::npos) << part << " is not in\n" << effective;
}

}  // namespace
}  // namespace tessera
