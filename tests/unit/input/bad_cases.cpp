#include <gtest/gtest.h>

#include <fstream>

#include "sample.hpp"

namespace tessera {
namespace {

struct Bad {
  const char* from;     // text of the sample ...
  const char* to;       // ... and what it is replaced by
  const char* place;    // line:column
  const char* key;      //
  const char* message;  // a part of it
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.to; }

class BadCase : public testing::TestWithParam<Bad> {};

TEST_P(BadCase, IsRefusedWithPlaceKeyAndCure) {
  const Bad& bad = GetParam();
  const std::string what = sample::error_of(sample::with(bad.from, bad.to));
  ASSERT_FALSE(what.empty()) << "accepted";
  const std::string start = std::string("dir/case.toml:") + bad.place + ": " + bad.key + (*bad.key ? ": " : "");
  EXPECT_EQ(what.substr(0, start.size()), start) << what;
  EXPECT_NE(what.find(bad.message), std::string::npos) << what;
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
}

const char* const box = "{ box = { min = [0, 0, 0], max = [\"1 m\", \"50 cm\", 0.1] } }";
const char* const lattice = "{ lattice = \"cubic\", counts = [21, 11, 3], jitter = 0.25, seed = 7 }";
const char* const second_body =
    "[[body]]\nname = \"b\"\nshape = { box = { min = [5,0,0], max = [6,1,1] } }\nparticles = { spacing = 1 }\n"
    "material = \"rubber\"\n";

INSTANTIATE_TEST_SUITE_P(
    Types, BadCase,
    testing::Values(
        Bad{"title = \"Punch\"", "title = 3", "1:9", "title", "found the number 3; expected a string"},
        Bad{"young = \"1 MPa\"", "young = true", "13:9", "material.0.young",
            "found true; expected a pressure in Pa, as in \"17 MPa\" or 17e6"},
        Bad{"young = \"1 MPa\"", "young = [1]", "13:9", "material.0.young", "found the list [1]; expected a pressure"},
        Bad{"young = \"1 MPa\"", "young = 2020-01-01", "13:9", "material.0.young", "found a date or time"},
        Bad{"young = \"1 MPa\"", "young = inf", "13:9", "material.0.young", "expected a finite number"},
        Bad{"young = \"1 MPa\"", "young = nan", "13:9", "material.0.young", "expected a finite number"},
        Bad{"cells = true", "cells = 1", "41:94", "output.fields.cells", "found the number 1; expected true or false"},
        Bad{"[21, 11, 3]", "[21, 11, 3.0]", "8:52", "body.0.particles.counts.2", "expected a list of three integers"},
        Bad{"[21, 11, 3]", "[21, 11]", "8:43", "body.0.particles.counts",
            "found a list of 2; expected a list of three integers; allowed: >= 1 and <= 1000000 (two are enough with "
            "method.dimension = 2)"},
        Bad{"[21, 11, 3]", "21", "8:43", "body.0.particles.counts", "found the number 21; expected a list of three"},
        Bad{"seed = 7", "seed = 7.5", "8:78", "body.0.particles.seed", "expected an integer"},
        Bad{"name = \"block\"", "name = \"a,b\"", "6:8", "body.0.name", "expected a name"},
        Bad{"name = \"block\"", "name = \"\"", "6:8", "body.0.name", "expected a name"},
        Bad{"where = [\"-x\", \"+x\"]", "where = [\"-x\", 3]", "25:16", "boundary.1.where.1",
            "found the number 3; expected a string or a list of strings"},
        Bad{"where = [\"-x\", \"+x\"]", "where = []", "25:9", "boundary.1.where", "found the list []"},
        Bad{"contact = { normal = 0.5, tangential = 2 }", "contact = 1", "16:11", "material.0.contact",
            "found the number 1; expected a table"},
        Bad{"[gravity]", "[[gravity]]", "33:1", "gravity", "expected a table"},
        Bad{"[[reference]]", "[reference]", "56:1", "reference", "expected a list of tables, [[reference]]"}));

INSTANTIATE_TEST_SUITE_P(
    Units, BadCase,
    testing::Values(
        Bad{"\"1 MPa\"", "\"1 kg\"", "13:9", "material.0.young",
            "found the string \"1 kg\", a mass in kg; expected a pressure in Pa, as in \"17 MPa\" or 17e6; allowed: > "
            "0"},
        Bad{"\"1 MPa\"", "\"1 MPaa\"", "13:12", "material.0.young", "unknown unit \"MPaa\""},
        Bad{"\"1 MPa\"", "\"1 Mpa\"", "13:12", "material.0.young", "did you mean \"MPa\"?"},
        Bad{"\"1 MPa\"", "\"stiff\"", "13:10", "material.0.young", "a number is expected at the start"},
        Bad{"\"1 MPa\"", "\"1\"", "13:9", "material.0.young", "found the string \"1\", a number; expected a pressure"},
        Bad{"\"1500 ms\"", "\"1500 mm\"", "36:7", "time.end", "a length in m; expected a time in s"},
        Bad{"\"auto-spectral\"", "\"1 m\"", "37:8", "time.step",
            "found the string \"1 m\", a length in m; expected \"auto\" or \"auto-spectral\", or a time in s"},
        Bad{"\"1 min wall\"", "\"1 m wall\"", "43:24", "output.checkpoint.every",
            "a length in m; expected a time in s"},
        Bad{"\"1 kPa\"", "\"1 N\"", "29:13", "boundary.2.traction.0",
            "a force in N; expected a list of three, each a pressure"},
        Bad{"\"2 bar\"", "\"2 barr\"", "32:15", "boundary.3.pressure", "unknown unit \"barr\""},
        Bad{"\"50 cm\"", "\"50 s\"", "7:50", "body.0.shape.box.max.1",
            "a time in s; expected a list of three, each a length"}));

INSTANTIATE_TEST_SUITE_P(
    Ranges, BadCase,
    testing::Values(
        Bad{"\"1 g/cm3\"", "-1000", "15:11", "material.0.density",
            "found the number -1000, out of range; allowed: > 0 (in kg/m3)"},
        Bad{"\"1 g/cm3\"", "\"-1 g/cm3\"", "15:11", "material.0.density", "out of range; allowed: > 0"},
        Bad{"\"1 MPa\"", "0", "13:9", "material.0.young", "out of range; allowed: > 0"},
        Bad{"0.45", "0.5", "14:11", "material.0.poisson",
            "found the number 0.5, out of range; allowed: > -1 and < 0.5"},
        Bad{"0.45", "-1", "14:11", "material.0.poisson", "out of range; allowed: > -1 and < 0.5"},
        Bad{"jitter = 0.25", "jitter = 0.5", "8:65", "body.0.particles.jitter",
            "out of range; allowed: >= 0 and <= 0.49"},
        Bad{"jitter = 0.25", "jitter = -0.1", "8:65", "body.0.particles.jitter", "allowed: >= 0 and <= 0.49"},
        Bad{"seed = 7", "seed = -7", "8:78", "body.0.particles.seed", "allowed: >= 0"},
        Bad{"[21, 11, 3]", "[21, 0, 3]", "8:48", "body.0.particles.counts.1",
            "found the number 0, out of range; allowed: >= 1"},
        Bad{"\"1500 ms\"", "-1", "36:7", "time.end", "allowed: >= 0"},
        Bad{"\"auto-spectral\"", "0", "37:8", "time.step", "allowed: > 0"},
        Bad{"safety = 0.8", "safety = 0", "38:10", "time.safety", "allowed: > 0 and <= 1"},
        Bad{"safety = 0.8", "safety = 1.01", "38:10", "time.safety", "allowed: > 0 and <= 1"},
        Bad{"\"2 1/s\"", "-1", "39:11", "time.damping", "allowed: >= 0"},
        Bad{"every = \"50 ms\"", "every = 0", "41:36", "output.fields.every", "allowed: > 0"},
        Bad{"every = \"1 ms\"", "every = -1", "42:21", "output.history.every", "allowed: > 0"},
        Bad{"\"1 min wall\"", "\"0 s wall\"", "43:24", "output.checkpoint.every", "allowed: > 0"},
        Bad{"normal = 0.5", "normal = -1", "16:22", "material.0.contact.normal", "allowed: >= 0"},
        Bad{"quadratic = 0.2", "quadratic = -1", "17:41", "material.0.viscosity.quadratic", "allowed: >= 0"},
        Bad{"[method]", "[method]\ndimension = 4", "3:13", "method.dimension", "allowed: >= 2 and <= 3"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, BadCase,
    testing::Values(
        Bad{"poisson =", "poison =", "14:1", "material.0.poison",
            "unknown key (did you mean \"poisson\"?); allowed here: name, model"},
        Bad{"jitter =", "jiter =", "8:56", "body.0.particles.jiter", "unknown key (did you mean \"jitter\"?)"},
        Bad{"min = [0, 0, 0]", "mni = [0, 0, 0]", "7:19", "body.0.shape.box.mni", "did you mean \"min\"?"},
        Bad{"tangential = 2", "shear = 2", "16:27", "material.0.contact.shear",
            "unknown key; allowed here: normal and tangential"},
        Bad{"title =", "jitter = 0.1\ntitle =", "1:1", "jitter", "did you mean \"body.particles.jitter\"?"},
        Bad{"[gravity]", "[gravty]", "33:2", "gravty", "did you mean \"gravity\"?"},
        Bad{"[method]", "[method]\nintegraton = \"nodal\"", "3:1", "method.integraton",
            "did you mean \"integration\"?"},
        Bad{"[method]", "[method]\nintegration = \"cells\"", "3:15", "method.integration",
            "found the string \"cells\"; expected \"nodal\""},
        Bad{"density = \"1 g/cm3\"\n", "", "10:1", "material.0.density",
            "missing; expected a density in kg/m3, as in \"1000 kg/m3\""},
        Bad{"end = \"1500 ms\"\n", "", "35:1", "time.end", "missing; expected a time in s"},
        Bad{"material = \"rubber\"\n", "", "5:1", "body.0.material", "missing"},
        Bad{"where = \"-z\"\n", "", "30:1", "boundary.3.where", "missing; expected a string"},
        Bad{"min = [0, 0, 0], ", "", "7:17", "body.0.shape.box.min", "missing; expected a list of three"},
        Bad{"where = \"y == max\"\n", "", "44:1", "probe.0.where", "missing; a reaction needs"},
        Bad{"at = [1, \"20 cm\", 0]\n", "", "48:1", "probe.1.at", "missing"},
        Bad{"quantity = \"von_mises\"\n", "", "52:1", "probe.2.quantity", "missing"},
        Bad{"quantity = \"von_mises\"", "quantity = \"von_mses\"", "55:12", "probe.2.quantity",
            "did you mean \"von_mises\"?"},
        Bad{"\"stress\"]", "\"strss\"]", "41:75", "output.fields.quantities.1", "unknown quantity \"strss\""},
        Bad{"type = \"point\"", "type = \"reaction\"\nwhere = \"-x\"", "52:6", "probe.1.at",
            "only has an effect with type = \"point\""},
        Bad{"title =", "title = \"a\"\ntitle =", "2:9", "", "not valid TOML"},
        Bad{"[gravity]", "[gravity", "33:9", "", "not valid TOML"}));

INSTANTIATE_TEST_SUITE_P(
    Choices, BadCase,
    testing::Values(
        Bad{"\"voronoi\"", "\"vornoi\"", "3:15", "method.formulation",
            "found the string \"vornoi\"; expected \"voronoi\" or \"delaunay\" (did you mean \"voronoi\"?)"},
        Bad{"\"variational\"", "\"quasistatic\"", "4:12", "method.boundary", "did you mean \"quasi-static\"?"},
        Bad{"\"neo-hookean\"", "\"neo-hooke\"", "12:9", "material.0.model", "did you mean \"neo-hookean\"?"},
        Bad{"\"symmetric\"", "\"symetric\"", "26:13", "boundary.1.condition", "did you mean \"symmetric\"?"},
        Bad{"\"auto-spectral\"", "\"automatic\"", "37:8", "time.step",
            "expected \"auto\" or \"auto-spectral\", or a time"},
        Bad{"\"csv\"", "\"cvs\"", "41:21", "output.fields.format", "did you mean \"csv\"?"},
        Bad{"\"cubic\"", "\"hexagonal\"", "8:25", "body.0.particles.lattice", "expected \"cubic\""},
        Bad{"\"reaction\"", "\"reactions\"", "46:8", "probe.0.type", "did you mean \"reaction\"?"}));

INSTANTIATE_TEST_SUITE_P(
    Together, BadCase,
    testing::Values(
        Bad{"boundary = \"variational\"", "boundary = \"quasi-static\"\nintegration = \"cell\"", "5:15",
            "method.integration", "derive from no energy"},
        Bad{"boundary = \"variational\"", "boundary = \"variational\"\nintegration = \"second-order\"", "5:15",
            "method.integration", "it needs formulation = \"voronoi\" and boundary = \"consistent\""},
        Bad{"material = \"rubber\"", "material = \"ruber\"", "9:12", "body.0.material",
            "found \"ruber\", no material of this case (did you mean \"rubber\"?); known: \"rubber\""},
        Bad{"condition = \"symmetric\"\n", "", "24:1", "boundary.1",
            "found none; expected exactly one of condition, displacement, rotation, velocity, "},
        Bad{"pressure = \"2 bar\"", "pressure = 1\ncondition = \"fixed\"", "33:1", "boundary.3.condition",
            "found pressure and condition together; expected exactly one of condition"},
        Bad{box, "{ name = \"a\" }", "7:9", "body.0.shape",
            "found none; expected exactly one of box, polygon, cylinder, cone, sphere, ellipsoid, torus, file, union, "
            "difference or intersection"},
        Bad{box, "{ box = { min = [0,0,0], max = [1,1,1] }, union = [] }", "7:51", "body.0.shape.union",
            "box and union together"},
        Bad{box, "{ union = [ { box = { min = [0,0,0], max = [1,1,1] } } ] }", "7:19", "body.0.shape.union",
            "found 1 shape; expected at least two"},
        Bad{box, "{ polygon = { points = [[0,0],[1,1]], thickness = 1 } }", "7:32", "body.0.shape.polygon.points",
            "found 2 points; expected a list of at least three pairs"},
        Bad{box, "{ polygon = { points = [[0,0],[1,1],[0,1,2]], thickness = 1 } }", "7:45",
            "body.0.shape.polygon.points.2", "pairs [x, y]"},
        Bad{box, "{ polygon = { points = [[0,0],[1,0],[0,1]] } }", "7:21", "body.0.shape.polygon.thickness", "missing"},
        Bad{"counts = [21, 11, 3]", "counts = [21, 11, 3], spacing = 1", "8:56", "body.0.particles.spacing",
            "counts and spacing together"},
        Bad{lattice, "{ lattice = \"cubic\" }", "8:13", "body.0.particles",
            "found none; expected exactly one of counts, spacing, count, file or mesh"},
        Bad{lattice, "{ file = \"a.csv\", jitter = 0.1 }", "8:40", "body.0.particles.jitter",
            "only has an effect with arrangement = \"lattice\""},
        Bad{lattice, "{ arrangement = \"relaxed\", counts = [2, 2, 2] }", "8:49", "body.0.particles.counts",
            "only has an effect with arrangement = \"lattice\""},
        Bad{lattice, "{ counts = [2, 2, 2], size = \"X\" }", "8:42", "body.0.particles.size",
            "only has an effect with spacing or count"},
        Bad{lattice, "{ arrangement = \"relaxed\", count = 10, size = \"t\" }", "8:59", "body.0.particles.size",
            "expected a formula in X, Y, Z"},
        Bad{lattice, "{ arrangement = \"relaxed\", count = 10, iterations = 0 }", "8:65", "body.0.particles.iterations",
            "allowed: >= 1"},
        Bad{lattice, "{ file = \"a.csv\", radius = \"t\" }", "8:40", "body.0.particles.radius",
            "expected a formula in X, Y, Z"},
        Bad{lattice, "{ count = 10, spacing = 1 }", "8:27", "body.0.particles.spacing",
            "expected exactly one of counts, spacing, count"},
        Bad{lattice, "{ mesh = \"a.msh\" }", "8:22", "body.0.particles.mesh",
            "a mesh needs method.formulation = \"delaunay\""},
        Bad{lattice, "{ file = \"\" }", "8:22", "body.0.particles.file", "expected a file name"},
        Bad{"[[material]]", "[[material]]\nname = \"rubber\"\nyoung = 1\npoisson = 0\ndensity = 1\n[[material]]",
            "16:8", "material.1.name", "found \"rubber\", which is already the name of material.0"},
        Bad{"name = \"tip\"", "name = \"punch\"", "49:8", "probe.1.name", "already the name of probe.0"},
        Bad{"where = \"-z\"", "where = \"-z\"\nbody = \"blok\"", "32:8", "boundary.3.body",
            "found \"blok\", no body of this case (did you mean \"block\"?); known: \"block\""}));

INSTANTIATE_TEST_SUITE_P(
    Formulas, BadCase,
    testing::Values(Bad{"\"-0.1*t\"", "\"-0.1*T\"", "23:26", "boundary.0.displacement.1",
                        "unknown name \"T\" (did you mean \"t\"?)"},
                    Bad{"\"10*X/6\"", "\"10*X/\"", "20:29", "initial.0.velocity.2", "it ends too early"},
                    Bad{"\"2*t\"", "\"free\"", "29:22", "boundary.2.traction.1", "found \"free\""},
                    Bad{"\"2*t\"", "\"2 t\"", "29:22", "boundary.2.traction.1", "a mass in kg; expected"},
                    Bad{"\"2 mm\"", "\"free\"", "19:30", "initial.0.displacement.2", "write 0 for none"},
                    Bad{"\"2 mm\"", "\"2 mm/s\"", "19:30", "initial.0.displacement.2", "a velocity in m/s; expected"},
                    Bad{"\"2 bar\"", "true", "32:12", "boundary.3.pressure", "found true; expected a pressure in Pa"},
                    Bad{"\"2 bar\"", "\"2*nn\"", "32:15", "boundary.3.pressure", "did you mean \"nx\"?"},
                    Bad{"\"-0.1*t\"", "\"1 mm*t\"", "23:20", "boundary.0.displacement.1",
                        "have none behind them, as in \"1e-3*t\""},
                    Bad{"\"-0.1*t\"", "\"nx\"", "23:21", "boundary.0.displacement.1", "unknown name \"nx\""},
                    Bad{"pressure = \"2 bar\"", "stress = [[1, 2, 3], [4, 5, 6]]", "32:10", "boundary.3.stress",
                        "found a list of 2; expected a list of three rows of three"},
                    Bad{"pressure = \"2 bar\"", "stress = [[1, 2, 3], [4, 5], [7, 8, 9]]", "32:22",
                        "boundary.3.stress.1", "found a list of 2"},
                    Bad{"pressure = \"2 bar\"", "rotation = { angle = \"t\" }\nvelocity = [0, 0, 0]", "33:1",
                        "boundary.3.velocity", "found rotation and velocity together"},
                    Bad{"pressure = \"2 bar\"", "rotation = { angle = \"t\", axis = [0, 0, 0] }", "32:34",
                        "boundary.3.rotation.axis", "found [0, 0, 0]; expected a direction"},
                    Bad{"pressure = \"2 bar\"", "rotation = { axis = [1, 0, 0] }", "32:12", "boundary.3.rotation.angle",
                        "missing"},
                    Bad{"pressure = \"2 bar\"", "rotation = { angle = 1 }\ndisplacement = [0, \"free\", 0]", "33:16",
                        "boundary.3.displacement", "beside a rotation"},
                    Bad{"pressure = \"2 bar\"", "following_pressure = 1\npressure = 2", "33:1", "boundary.3.pressure",
                        "found following_pressure and pressure together"},
                    Bad{"name = \"tip\"", "name = \"tip\"\nabout = [0, 0, 0]", "50:9", "probe.1.about",
                        "only has an effect with type = \"reaction\""},
                    Bad{"\"-0.1*t\"", "\"\"", "23:21", "boundary.0.displacement.1", "it is empty"}));

TEST(SeveralBodies, MustBeNamedInEveryEntry) {
  const std::string two = sample::with("[[material]]", second_body + std::string("[[material]]"));
  EXPECT_EQ(
      sample::error_of(two),
      "dir/case.toml:23:1: initial.0.body: missing; with several bodies say which one is meant: \"block\" or \"b\"");
  const auto name_initial = two.find("[[initial]]");
  std::string named = two;
  named.insert(name_initial + 12, "body = \"b\"\n");
  EXPECT_NE(sample::error_of(named).find("boundary.0.body: missing"), std::string::npos) << sample::error_of(named);
}

TEST(SeveralBodies, MustHaveDifferentNames) {
  std::string two = sample::with("[[material]]", second_body + std::string("[[material]]"));
  two.replace(two.find("name = \"b\"\n"), 10, "name = \"block\"");
  EXPECT_EQ(sample::error_of(two),
            "dir/case.toml:11:8: body.1.name: found \"block\", which is already the name of body.0; every body needs "
            "its own");
}

TEST(SeveralBodies, EnergyAndMomentumMayBeThoseOfAll) {
  std::string text = sample::with("[[material]]", second_body + std::string("[[material]]"));
  text = text.substr(0, text.find("[[initial]]")) + "[time]\nend = 1\n[[probe]]\nname = \"p\"\ntype = \"momentum\"\n";
  EXPECT_EQ(sample::read(text).probes.at(0).body, "");
  EXPECT_NE(sample::error_of(text + "[[probe]]\nname = \"q\"\ntype = \"reaction\"\nwhere = \"-x\"\n")
                .find("probe.1.body: missing"),
            std::string::npos);
}

TEST(TwoDimensions, HaveOneLayer) {
  const std::string what = sample::error_of(sample::with("[method]", "[method]\ndimension = 2"));
  EXPECT_NE(what.find("body.0.particles.counts: found 3 in z; expected 1"), std::string::npos) << what;
}

TEST(CaseFile, ThatCannotBeReadIsAnInputError) {
  for (const char* path : {"no/such/file.toml", "."}) {
    try {
      read_case(path, {});
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path, 0), 0U) << error.what();
      EXPECT_EQ(error.status(), ExitStatus::input);
    }
  }
}

TEST(CaseFile, MayBeEmptyOrRubbishWithoutHarm) {
  EXPECT_EQ(sample::error_of(""), "dir/case.toml:1:1: body: missing; expected a list of tables");
  for (const char* text : {"[", "[[", "a", "= 3", "\x00\x01\xff", "[[body]]\n[[body]", "a = \"", "a = '''",
                           "\xef\xbb\xbf[", "[a.b.c]\n[a]\nb = 1", "x = {", "x = [[[[[[[[", "body = []", "body = [1]"})
    EXPECT_FALSE(sample::error_of(text).empty()) << text;
}

}  // namespace
}  // namespace tessera
