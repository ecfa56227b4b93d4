#include <gtest/gtest.h>

#include "support/radii.hpp"
#include "surface_helpers.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera::test {
namespace {

/// |x - X_a|^2 - r_a^2.
double power(const std::vector<Vec3>& points, const std::vector<double>& weights, std::size_t a, const Vec3& x) {
  return norm2(x - points[a]) - weights[a];
}

/// The centroid of a face is as far, by power, from both its particles, and farther from all others.
void expect_power_faces(const Cells& cells, const std::vector<Vec3>& points, const std::vector<double>& weights,
                        double spacing) {
  const double tolerance = 1e-12 * spacing * spacing;
  for (const InteriorFace& f : cells.interior) {
    if (!f.bisects) continue;
    const double own = power(points, weights, static_cast<std::size_t>(f.a), f.centroid);
    EXPECT_NEAR(own, power(points, weights, static_cast<std::size_t>(f.b), f.centroid), tolerance);
    for (std::size_t c = 0; c < points.size(); ++c) EXPECT_GE(power(points, weights, c, f.centroid), own - tolerance);
    const Vec3 X = points[static_cast<std::size_t>(f.a)], branch = points[static_cast<std::size_t>(f.b)] - X;
    EXPECT_NEAR(dot(f.centroid - (X + f.cut * branch), branch), 0.0, tolerance);
  }
}

/// Two particles 0.4 m apart with squared radii that differ by 0.04 m2: the plane moves by 0.04 / (2 0.4) = 0.05 m.
TEST(PowerCellShapes, TwoParticles) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const std::vector<Vec3> points{{0.3, 0.5, 0.5}, {0.7, 0.5, 0.5}};
  const std::vector<double> weights{0.05, 0.01};
  const Cells cells = voronoi_cells({points, weights}, solid);
  EXPECT_NEAR(cells.volume[0], 0.55, 1e-15);
  EXPECT_NEAR(cells.volume[1], 0.45, 1e-15);
  ASSERT_EQ(cells.interior.size(), 1U);
  EXPECT_NEAR(cells.interior[0].cut, 0.25 / 0.4, 1e-15);
  EXPECT_NEAR(cells.interior[0].centroid.x, 0.55, 1e-15);
}

/// Equal radii, whatever they are, make Voronoi cells, to the last bit.
TEST(PowerCellShapes, OfEqualRadiiAreVoronoiCells) {
  const Solid solid = build_solid(l_polygon());
  const std::vector<Vec3> points = points_inside(solid, 0.8, 0.3, 1);
  const std::vector<double> weights(points.size(), 0.3);
  const Cells power = voronoi_cells({points, weights}, solid), plain = voronoi_cells(points, solid);
  EXPECT_EQ(power.volume, plain.volume);
  ASSERT_EQ(power.interior.size(), plain.interior.size());
  for (std::size_t i = 0; i < plain.interior.size(); ++i) {
    EXPECT_EQ(power.interior[i].area, plain.interior[i].area);
    EXPECT_EQ(power.interior[i].cut, 0.5);
  }
}

TEST(PowerCellShapes, FillSolidsExactly) {
  const std::vector<SolidCase> solids{{"box", box({0, 0, 0}, {1, 1, 1}), 0.2},
                                      {"L", l_polygon(), 0.9},
                                      {"hole", hole(), 0.15},
                                      {"cavity", cavity(), 0.15},
                                      {"star", star(), 0.4}};
  for (const SolidCase& s : solids)
    for (const unsigned seed : {1U, 2U}) {
      SCOPED_TRACE(s.name);
      const Solid solid = build_solid(s.shape);
      const std::vector<Vec3> points = points_inside(solid, s.spacing, 0.2, seed);
      const std::vector<double> weights = weights_up_to(0.55 * s.spacing, points.size(), seed);
      const Cells cells = voronoi_cells({points, weights}, solid);
      expect_closed(cells, points, solid, 5e-13);
      expect_power_faces(cells, points, weights, s.spacing);
    }
}

/// A lattice has many generators as far from a corner, with equal and with two radii.
TEST(PowerCellShapes, OfALatticeWithTwoRadii) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const TriangleSurface surface = box_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceIndex index(surface);
  const std::vector<Vec3> points = points_of(lattice(0.2), solid);
  std::vector<double> weights;
  for (std::size_t a = 0; a < points.size(); ++a) weights.push_back(a % 2 == 0 ? 0.01 : 0.0);
  const Cells cells = voronoi_cells({points, weights}, solid);
  expect_closed(cells, points, solid, 5e-13);
  const SurfaceCells made = surface_cells({points, weights}, index);
  expect_exact(made, points, surface, "lattice");
  for (std::size_t a = 0; a < points.size(); ++a) EXPECT_NEAR(cells.volume[a], made.cells.volume[a], 1e-15);
}

/// The two cutters have nothing in common but the plane's equation.
TEST(PowerCellShapes, InSurfacesAreThoseOfConvexPieces) {
  const Solid solid = build_solid(hole());
  const TriangleSurface surface =
      grid_surface({{{0, 0.3, 0.6, 1}, {0, 0.3, 0.7, 1}, {0, 1}}}, [](int i, int j, int) { return i != 1 || j != 1; });
  const SurfaceIndex index(surface);
  const std::vector<Vec3> points = points_inside(solid, 0.125, 0.2, 1);
  const std::vector<double> weights = weights_up_to(0.06, points.size(), 1);
  const Cells pieces = voronoi_cells({points, weights}, solid);
  const SurfaceCells made = surface_cells({points, weights}, index);
  for (std::size_t a = 0; a < points.size(); ++a) {
    EXPECT_NEAR(pieces.volume[a], made.cells.volume[a], 1e-14);
    EXPECT_LT(norm(pieces.centroid[a] - made.cells.centroid[a]), 1e-12);
  }
}

TEST(PowerCellShapes, FillSurfacesExactly) {
  for (const TriangleSurface& surface :
       {ball_surface(1.0, 12, 24), turned(gear_surface(9, 0.4, 1.0, 1.3, 0.5), 0.7), spiky_surface(1, 20, 40, 0.3)}) {
    const SurfaceIndex index(surface);
    const std::vector<Vec3> points = lattice_in(index, 0.2, 0.2, 1);
    const std::vector<double> weights = weights_up_to(0.1, points.size(), 1);
    const SurfaceCells made = surface_cells({points, weights}, index);
    expect_exact(made, points, surface, "power");
    expect_power_faces(made.cells, points, weights, 0.2);
  }
}

TEST(PowerCellShapes, RefuseParticlesOutsideTheirCells) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const TriangleSurface surface = box_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceIndex index(surface);
  const std::vector<Vec3> points{{0.2, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0.8, 0.5, 0.5}, {0.5, 0.2, 0.5}};
  const std::vector<double> weights{0.0, 0.1, 0.0, 0.0};
  const std::vector<Index> names{10, 11, 12, 13};
  for (const auto& make : {std::function<void()>([&] {
                             voronoi_cells({points, weights, names}, solid);
                           }),
                           std::function<void()>([&] {
                             surface_cells({points, weights, names}, index);
                           })}) {
    const std::string message = message_of<GeometryError>(make);
    expect_contains(message, "particle 10 at (0.2, 0.5, 0.5) m, radius 0 m, lies outside its own power cell");
    expect_contains(message, "in that of particle 11 at (0.5, 0.5, 0.5) m, radius 0.316228 m");
  }
}

/// No vertex has a smaller power to the sphere orthogonal to those of a tetrahedron's vertices than these have.
TEST(RegularTetrahedra, AreTheDualOfPowerCells) {
  if (!has_delaunay()) GTEST_SKIP() << "built without CGAL's triangulation";
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  PointSet set = place_particles(lattice({6, 6, 6}, 0.2, 3), solid, Placement::vertices);
  for (const double w : weights_up_to(0.1, set.points.size(), 2)) set.radius.push_back(std::sqrt(w));
  const TetrahedralMesh mesh = tetrahedralize(set, solid, Tetrahedralization::automatic);
  std::vector<double> weights;
  for (const double r : set.radius) weights.push_back(r * r);
  for (const auto& t : mesh.tetrahedra) {
    const auto v = [&](std::size_t i) { return static_cast<std::size_t>(t[i]); };
    const Vec3& base = set.points[v(0)];
    std::array<Vec3, 3> row;
    Vec3 right;
    for (std::size_t i = 0; i < 3; ++i) {
      row[i] = set.points[v(i + 1)] - base;
      right[static_cast<int>(i)] = 0.5 * (norm2(row[i]) + weights[v(0)] - weights[v(i + 1)]);
    }
    const double det = dot(row[0], cross(row[1], row[2]));
    if (det < 1e-4) continue;  // a sliver, whose centre is not known well
    const Vec3 center =
        base +
        (right.x * cross(row[1], row[2]) + right.y * cross(row[2], row[0]) + right.z * cross(row[0], row[1])) / det;
    const double own = power(set.points, weights, v(0), center);
    for (std::size_t c = 0; c < set.points.size(); ++c)
      EXPECT_GE(power(set.points, weights, c, center), own - 1e-5 * (1.0 + norm2(center)));
  }
  const TetrahedralMesh plain = tetrahedralize({set.points, set.lattice}, solid, Tetrahedralization::automatic);
  EXPECT_NE(mesh.tetrahedra, plain.tetrahedra);
}

TEST(RegularTetrahedra, RefuseEmptyPowerCellsAndSplitLattices) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  PointSet set = place_particles(lattice({3, 3, 3}), solid, Placement::vertices);
  set.radius.assign(set.points.size(), 0.5);
  set.radius[13] = 0.0;  // in the middle, 0.5 m from its neighbours
  expect_contains(message_of<GeometryError>([&] { tetrahedralize(set, solid, Tetrahedralization::split); }),
                  "without regard to radii");
  if (!has_delaunay()) {
    expect_contains(message_of<GeometryError>([&] { tetrahedralize(set, solid, Tetrahedralization::automatic); }),
                    "CGAL");
    return;
  }
  for (double& r : set.radius) r *= 1.5;
  const std::string message =
      message_of<GeometryError>([&] { tetrahedralize(set, solid, Tetrahedralization::automatic); });
  expect_contains(message,
                  "first particle 13 at (0.5, 0.5, 0.5) m, radius 0 m, which lies in the power cell of particle 4 at "
                  "(0.5, 0.5, 0) m, "
                  "radius 0.75 m");
  expect_contains(message, "power cell of each is empty");
}

}  // namespace
}  // namespace tessera::test
