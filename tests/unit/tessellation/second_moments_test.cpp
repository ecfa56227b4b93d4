#include <gtest/gtest.h>

#include "surface_helpers.hpp"

namespace tessera::test {
namespace {

double size_of(const Symmetric3& m) { return std::sqrt(contract(to_mat3(m), to_mat3(m))); }

/// The integral of Y (x) Y over the tetrahedra from the origin to triangles.
Symmetric3 second_moment_of(const TriangleSurface& surface) {
  Symmetric3 sum;
  for (Index t = 0; t < static_cast<Index>(surface.triangles.size()); ++t) {
    const auto [u, v, w] = surface.corners(t);
    sum += (dot(u, cross(v, w)) / 120.0) * (square(u) + square(v) + square(w) + square(u + v + w));
  }
  return sum;
}

Symmetric3 second_moment_of_box(const Vec3& lower, const Vec3& upper) {
  return second_moment_of(box_surface(lower, upper));
}

/// The second moment about the origin of everything the cells hold.
Symmetric3 second_moment_of(const Cells& cells) {
  Symmetric3 sum;
  for (std::size_t a = 0; a < cells.volume.size(); ++a)
    sum += cells.second_moment[a] + cells.volume[a] * square(cells.centroid[a]);
  return sum;
}

/// The largest difference between cells' second moments and the sums of cones from the centroids to the faces, whose
/// second moments are their bases' times a fifth of the height. Relative to the cell's own.
double largest_misfit_of_faces(const Cells& cells) {
  std::vector<Symmetric3> sum(cells.volume.size());
  const auto add_cone = [&](Index cell, const Vec3& area, const Vec3& centroid, const Symmetric3& second) {
    const auto a = static_cast<std::size_t>(cell);
    const double A = norm(area);
    const Vec3 C = centroid - cells.centroid[a];
    sum[a] += (0.2 * dot(area, C) / A) * (second + A * square(C));
  };
  for (std::size_t f = 0; f < cells.interior.size(); ++f) {
    const InteriorFace& face = cells.interior[f];
    add_cone(face.a, face.area, face.centroid, cells.interior_second_moment[f]);
    add_cone(face.b, -face.area, face.centroid, cells.interior_second_moment[f]);
  }
  for (std::size_t f = 0; f < cells.boundary.size(); ++f) {
    const BoundaryFace& face = cells.boundary[f];
    add_cone(face.owner, face.area, face.centroid, cells.boundary_second_moment[f]);
  }
  double largest = 0.0;
  for (std::size_t a = 0; a < sum.size(); ++a)
    largest = std::max(largest, size_of(sum[a] - cells.second_moment[a]) / size_of(cells.second_moment[a]));
  return largest;
}

void expect_moments(const Cells& cells, const Symmetric3& of_solid, const std::string& what) {
  ASSERT_EQ(cells.interior_second_moment.size(), cells.interior.size()) << what;
  ASSERT_EQ(cells.boundary_second_moment.size(), cells.boundary.size()) << what;
  EXPECT_LE(size_of(second_moment_of(cells) - of_solid), 1e-12 * size_of(of_solid)) << what;
  EXPECT_LE(largest_misfit_of_faces(cells), 1e-11) << what;
}

TEST(SecondMoments, OfABoxInOneCell) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 2, 3}));
  const Cells cells = voronoi_cells(std::vector<Vec3>{{0.2, 0.3, 0.4}}, solid, Moments::second_of_faces);
  EXPECT_LE(size_of(cells.second_moment[0] - Symmetric3{0.5, 0, 0, 2, 0, 4.5}), 1e-14);  // V (1, 4, 9) / 12
  for (std::size_t f = 0; f < cells.boundary.size(); ++f) {
    const Vec3 A = cells.boundary[f].area;
    const Symmetric3 expected =
        A.x != 0 ? Symmetric3{0, 0, 0, 2, 0, 4.5}
                 : (A.y != 0 ? Symmetric3{0.25, 0, 0, 0, 0, 2.25} : Symmetric3{1. / 6, 0, 0, 2. / 3, 0, 0});
    EXPECT_LE(size_of(cells.boundary_second_moment[f] - expected), 1e-14) << f;
  }
}

TEST(SecondMoments, AreLeftOutUnlessAskedFor) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const std::vector<Vec3> points{{0.2, 0.3, 0.4}, {0.7, 0.6, 0.5}};
  EXPECT_TRUE(voronoi_cells(points, solid).second_moment.empty());
  const Cells cells = voronoi_cells(points, solid, Moments::second_of_cells);
  EXPECT_EQ(cells.second_moment.size(), 2U);
  EXPECT_TRUE(cells.interior_second_moment.empty());
  EXPECT_TRUE(cells.boundary_second_moment.empty());
}

TEST(SecondMoments, AddUpInConvexPieces) {
  const Shape L = difference_of({box({0, 0, 0}, {1, 1, 1}), box({0.4, 0.5, -1}, {2, 2, 2})});
  const Symmetric3 of_cube = second_moment_of_box({0, 0, 0}, {1, 1, 1});
  const Symmetric3 of_L = of_cube - second_moment_of_box({0.4, 0.5, 0}, {1, 1, 1});
  const Symmetric3 of_hollow = of_cube - second_moment_of_box({0.3, 0.3, 0.4}, {0.6, 0.7, 0.6});
  for (const double jitter : {0.0, 0.3, 0.49}) {
    const auto check = [&](const Shape& shape, const Symmetric3& expected, const char* what) {
      const Solid solid = build_solid(shape);
      expect_moments(voronoi_cells(points_inside(solid, 0.125, jitter, 3), solid, Moments::second_of_faces), expected,
                     what);
    };
    check(box({0, 0, 0}, {1, 1, 1}), of_cube, "box");
    check(L, of_L, "L-block");
    check(cavity(), of_hollow, "cavity");
  }
}

TEST(SecondMoments, AddUpInSurfaces) {
  const std::vector<std::pair<std::string, TriangleSurface>> bodies{
      {"ball", ball_surface(1.0, 12, 24)},
      {"torus", torus_surface(1.0, 0.4, 30, 12)},
      {"L-block",
       grid_surface({{{0, 0.4, 1}, {0, 0.5, 1}, {0, 1}}}, [](int i, int j, int) { return i == 0 || j == 0; })},
      {"slit",
       grid_surface({{{0, 0.5, 0.52, 1}, {0, 0.5, 1}, {0, 1}}}, [](int i, int j, int) { return i != 1 || j != 1; })}};
  for (const auto& [name, surface] : bodies)
    for (const double jitter : {0.0, 0.25, 0.45}) {
      const SurfaceIndex index(surface);
      const SurfaceCells made = surface_cells(lattice_in(index, 0.2, jitter, 2), index, Moments::second_of_faces);
      expect_moments(made.cells, second_moment_of(surface), name);
    }
}

/// Convex pieces and surfaces measure in quite different ways.
TEST(SecondMoments, AreTheSameInPiecesAndSurfaces) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const TriangleSurface surface_of_box = box_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceIndex index(surface_of_box);
  const std::vector<Vec3> points = points_inside(solid, 0.2, 0.3, 4);
  const Cells pieces = voronoi_cells(points, solid, Moments::second_of_cells);
  const Cells surface = surface_cells(points, index, Moments::second_of_cells).cells;
  for (std::size_t a = 0; a < points.size(); ++a)
    EXPECT_LE(size_of(pieces.second_moment[a] - surface.second_moment[a]), 1e-12 * size_of(pieces.second_moment[a]));
}

}  // namespace
}  // namespace tessera::test
