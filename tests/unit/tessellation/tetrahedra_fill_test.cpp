#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mesh_helpers.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/geometry/solid.hpp"

namespace tessera::test {
namespace {

Shape box(const Vec3& min, const Vec3& max, const std::string& name = "") {
  Shape shape;
  shape.name = name;
  shape.kind = BoxShape{min, max};
  return shape;
}

Shape l_block() {
  Shape shape;
  shape.kind = PolygonShape{{{{0, 0}}, {{6, 0}}, {{6, 3}}, {{3, 3}}, {{3, 10}}, {{0, 10}}}, 0.0, 3.0};
  return shape;
}

PointSet lattice(const Solid& solid, double spacing, double jitter, std::uint64_t seed = 1) {
  LatticeSpec spec;
  spec.spacing = spacing;
  spec.jitter = jitter;
  spec.seed = seed;
  return place_particles({spec, {}}, solid, Placement::vertices);
}

struct Way {
  Tetrahedralization how;
  double jitter;
};

class Fill : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    if (GetParam().how == Tetrahedralization::delaunay && !has_delaunay()) GTEST_SKIP() << "built without CGAL";
  }
};

TEST_P(Fill, BoxIsFilledAndItsSidesAreWhole) {
  const Solid solid = build_solid(box({-1, 0, 0}, {1, 1, 0.5}));
  const PointSet points = lattice(solid, 0.25, GetParam().jitter);
  const TetrahedralMesh mesh = tetrahedralize(points, solid, GetParam().how);
  expect_sound(mesh);
  EXPECT_EQ(mesh.points.size(), 9u * 5u * 3u);
  EXPECT_NEAR(volume_of(mesh), 1.0, 1e-13);
  expect_near(area_of(mesh, "-x"), {-0.5, 0, 0}, 1e-13);
  expect_near(area_of(mesh, "+x"), {0.5, 0, 0}, 1e-13);
  expect_near(area_of(mesh, "-y"), {0, -1, 0}, 1e-13);
  expect_near(area_of(mesh, "+y"), {0, 1, 0}, 1e-13);
  expect_near(area_of(mesh, "-z"), {0, 0, -2}, 1e-13);
  expect_near(area_of(mesh, "+z"), {0, 0, 2}, 1e-13);
}

TEST_P(Fill, NonConvexBlockIsFilledUpToItsReentrantEdge) {
  const Solid solid = build_solid(l_block());
  const TetrahedralMesh mesh = tetrahedralize(lattice(solid, 1.0, GetParam().jitter), solid, GetParam().how);
  expect_sound(mesh);
  EXPECT_NEAR(volume_of(mesh), 117.0, 1e-11);
  expect_near(area_of(mesh, "edge3"), {0, 9, 0}, 1e-12);
  expect_near(area_of(mesh, "edge4"), {21, 0, 0}, 1e-12);
  expect_near(area_of(mesh, "+z"), {0, 0, 39}, 1e-12);
}

TEST_P(Fill, SidesThatShareAPlaneAreToldApart) {
  Shape parts;
  parts.kind = UnionShape{{box({0, 0, 0}, {1, 1, 1}, "left"), box({1, 0, 0}, {3, 1, 1}, "right")}};
  const Solid solid = build_solid(parts);
  const TetrahedralMesh mesh = tetrahedralize(lattice(solid, 0.5, 0.0), solid, GetParam().how);
  expect_sound(mesh);
  expect_near(area_of(mesh, "left.+z"), {0, 0, 1}, 1e-13);
  expect_near(area_of(mesh, "right.+z"), {0, 0, 2}, 1e-13);
  expect_near(area_of(mesh, "+z"), {0, 0, 3}, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Ways, Fill,
                         testing::Values(Way{Tetrahedralization::delaunay, 0.0}, Way{Tetrahedralization::delaunay, 0.1},
                                         Way{Tetrahedralization::delaunay, 0.25}, Way{Tetrahedralization::split, 0.0},
                                         Way{Tetrahedralization::split, 0.1}, Way{Tetrahedralization::automatic, 0.1}),
                         [](const auto& instance) {
                           const char* how = instance.param.how == Tetrahedralization::delaunay ? "delaunay"
                                             : instance.param.how == Tetrahedralization::split  ? "split"
                                                                                                : "automatic";
                           return std::string(how) + std::to_string(static_cast<int>(100 * instance.param.jitter));
                         });

/// The lattice of one unit cube, its node (i, j, k) being particle i + 2 j + 4 k.
PointSet cube() {
  PointSet set;
  for (int n = 0; n < 8; ++n) set.points.push_back({double(n & 1), double(n >> 1 & 1), double(n >> 2)});
  set.lattice = Lattice{{2, 2, 2}, {0, 0, 0}, {1, 1, 1}, {0, 1, 2, 3, 4, 5, 6, 7}};
  return set;
}

Solid unit_cube() { return build_solid(box({0, 0, 0}, {1, 1, 1})); }

TEST(Split, CubeBecomesTheSixTetrahedraAroundItsDiagonal) {
  const TetrahedralMesh mesh = tetrahedralize(cube(), unit_cube(), Tetrahedralization::split);
  const std::vector<Tetrahedron> expected{{0, 1, 3, 7}, {0, 1, 7, 5}, {0, 2, 6, 7},
                                          {0, 2, 7, 3}, {0, 4, 5, 7}, {0, 4, 7, 6}};
  EXPECT_EQ(mesh.tetrahedra, expected);
  for (const Tetrahedron& t : mesh.tetrahedra) EXPECT_DOUBLE_EQ(six_volume(t, mesh.points), 1.0);
}

TEST(Split, InvertedTetrahedronIsNamed) {
  const Solid solid = build_solid(box({0, 0, 0}, {2, 2, 2}));
  PointSet set = lattice(solid, 1.0, 0.0);
  const Index middle = set.lattice->particle[13];
  set.points[static_cast<std::size_t>(middle)] = {1.9, 1.9, 0.1};
  const std::string message = geometry_error([&] { tetrahedralize(set, solid, Tetrahedralization::split); });
  expect_contains(message, {"inverts", "cell (", "less jitter", std::to_string(middle).c_str()});
}

TEST(Split, PointsWithoutALatticeAreRefused) {
  PointSet set = cube();
  set.lattice.reset();
  const std::string message = geometry_error([&] { tetrahedralize(set, unit_cube(), Tetrahedralization::split); });
  expect_contains(message, {"no lattice", "CGAL", "mesh file"});
}

TEST(Split, ParticleOutsideEveryWholeCellIsNamed) {
  const Solid solid = build_solid(l_block());
  PointSet set = cube();
  set.points.push_back({0.5, 0.5, 2.0});
  const std::string message = geometry_error([&] { tetrahedralize(set, solid, Tetrahedralization::split); });
  expect_contains(message, {"1 of 9 particles", "particle 8 at (0.5, 0.5, 2)"});
}

TEST(Split, SolidThatTheLatticeDoesNotReachIsRefusedWithThePlace) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 2}));
  const std::string message = geometry_error([&] { tetrahedralize(cube(), solid, Tetrahedralization::split); });
  expect_contains(message, {"do not fill the solid", "volume 1 of 2 m3", "lies on none of its sides",
                            "every side, edge and corner"});
}

class DelaunayFill : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_delaunay()) GTEST_SKIP() << "built without CGAL";
  }
};

TEST_F(DelaunayFill, CutOffCornerIsRefused) {
  PointSet set = cube();
  set.points.pop_back();
  set.lattice.reset();
  const std::string message = geometry_error([&] { tetrahedralize(set, unit_cube(), Tetrahedralization::delaunay); });
  expect_contains(message, {"do not fill the solid", "particles 3, 6, 5 at (0.666667, 0.666667, 0.666667)",
                            "every side, edge and corner"});
}

TEST_F(DelaunayFill, DoubledParticleIsNamed) {
  PointSet set = cube();
  set.points.push_back(set.points[3]);
  const std::string message = geometry_error([&] { tetrahedralize(set, unit_cube(), Tetrahedralization::delaunay); });
  expect_contains(message, {"1 of 9 particles belong to no tetrahedron", "(1, 1, 0)"});
}

TEST_F(DelaunayFill, ParticlesInOnePlaneAreRefused) {
  PointSet set;
  set.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::string message = geometry_error([&] { tetrahedralize(set, unit_cube(), Tetrahedralization::delaunay); });
  expect_contains(message, {"one plane", "two layers"});
}

TEST_F(DelaunayFill, NumberingDoesNotChangeTheTetrahedraOfARegularLattice) {
  const Solid solid = unit_cube();
  const PointSet set = lattice(solid, 0.2, 0.0);
  PointSet reversed = set;
  std::reverse(reversed.points.begin(), reversed.points.end());
  std::vector<Tetrahedron> renumbered = tetrahedralize(reversed, solid, Tetrahedralization::delaunay).tetrahedra;
  const Index last = static_cast<Index>(set.points.size()) - 1;
  for (Tetrahedron& t : renumbered) {
    for (Index& v : t) v = last - v;
    t = canonical(t);
  }
  std::sort(renumbered.begin(), renumbered.end());
  EXPECT_EQ(renumbered, tetrahedralize(set, solid, Tetrahedralization::delaunay).tetrahedra);
}

TEST_F(DelaunayFill, RoundedSlantedSidesLeaveNoFlatTetrahedra) {
  // Points on slanted sides miss their planes by rounding, so the hull has slivers that must go.
  Shape shape;
  shape.kind = PolygonShape{{{{0, 0}}, {{1, 0.3}}, {{0.7, 1.3}}, {{-0.3, 1}}}, 0.1, 0.3};
  const Solid solid = build_solid(shape);
  PointSet set;
  for (int k = 0; k <= 3; ++k)
    for (int j = 0; j <= 7; ++j)
      for (int i = 0; i <= 7; ++i) {
        const double u = i / 7.0, v = j / 7.0;
        set.points.push_back({u * 1.0 - v * 0.3, u * 0.3 + v * 1.0, 0.1 + k * 0.1});
      }
  const TetrahedralMesh mesh = tetrahedralize(set, solid, Tetrahedralization::delaunay);
  expect_sound(mesh);
  EXPECT_NEAR(volume_of(mesh), 1.09 * 0.3, 1e-13);
  for (const Tetrahedron& t : mesh.tetrahedra) EXPECT_GT(six_volume(t, mesh.points), 1e-9);
}

TEST_F(DelaunayFill, RegularLatticeGivesTheTetrahedraOfTheSplit) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 2, 3}));
  LatticeSpec spec;
  spec.counts = {{4, 5, 6}};
  const PointSet set = place_particles({spec, {}}, solid, Placement::vertices);
  EXPECT_EQ(tetrahedralize(set, solid, Tetrahedralization::delaunay).tetrahedra,
            tetrahedralize(set, solid, Tetrahedralization::split).tetrahedra);
}

/// A unit cube turned about z by a, then about x by b, as a solid made by hand.
struct TurnedCube {
  double a, b;

  Vec3 turn(const Vec3& v) const {
    const Vec3 w{std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
    return {w.x, std::cos(b) * w.y - std::sin(b) * w.z, std::sin(b) * w.y + std::cos(b) * w.z};
  }

  Solid solid() const {
    Solid cube;
    cube.pieces.emplace_back();
    for (const Vec3& N :
         {Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}, Vec3{0, 0, 1}}) {
      const Plane plane{turn(N), N.x + N.y + N.z > 0.0 ? 1.0 : 0.0};
      cube.pieces[0].walls.push_back({plane, static_cast<Index>(cube.sides.size())});
      cube.sides.push_back({{"side" + std::to_string(cube.sides.size())}, plane});
    }
    cube.lower = cube.pieces[0].lower = {-2, -2, -2};
    cube.upper = cube.pieces[0].upper = {2, 2, 2};
    cube.volume = 1.0;
    return cube;
  }
};

TEST_F(DelaunayFill, TurnedLatticeLeavesNoSlivers) {
  // Rounding makes every rectangle of the lattice nearly, but not quite, flat and cyclic.
  for (int turn = 1; turn <= 10; ++turn) {
    const TurnedCube cube{0.3 * turn, 0.2 * turn};
    PointSet set;
    for (int n = 0; n < 216; ++n) set.points.push_back(cube.turn({n % 6 / 5.0, n / 6 % 6 / 5.0, n / 36 / 5.0}));
    const TetrahedralMesh mesh = tetrahedralize(set, cube.solid(), Tetrahedralization::delaunay);
    expect_sound(mesh);
    EXPECT_EQ(mesh.tetrahedra.size(), 6u * 125u);
    for (const Tetrahedron& t : mesh.tetrahedra) EXPECT_NEAR(six_volume(t, mesh.points), 0.008, 1e-14);
  }
}

TEST_F(DelaunayFill, ReentrantEdgesHoldWithTheLargestJitter) {
  const Solid solid = build_solid(l_block());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TetrahedralMesh mesh = tetrahedralize(lattice(solid, 1.0, 0.49, seed), solid, Tetrahedralization::delaunay);
    expect_sound(mesh);
    EXPECT_NEAR(volume_of(mesh), 117.0, 1e-11);
    expect_near(area_of(mesh, "edge3"), {0, 9, 0}, 1e-12);
  }
}

TEST(Delaunay, WithoutCgalTheErrorSaysWhatToInstall) {
  if (has_delaunay()) GTEST_SKIP() << "built with CGAL";
  const std::string message =
      geometry_error([&] { tetrahedralize(cube(), unit_cube(), Tetrahedralization::delaunay); });
  expect_contains(message, {"libcgal-dev", "TESSERA_WITH_CGAL"});
}

}  // namespace
}  // namespace tessera::test
