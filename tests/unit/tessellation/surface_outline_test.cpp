#include "tessera/tessellation/surface_outline.hpp"

#include <gtest/gtest.h>

#include "surface_helpers.hpp"

namespace tessera::test {
namespace {

/// Area vector and volume, relative to the origin, of polygons of any outline.
struct Measure {
  Vec3 area;
  double volume = 0.0;

  void add(const std::vector<Index>& polygon, const std::vector<Vec3>& vertices) {
    const auto at = [&](std::size_t i) { return vertices[static_cast<std::size_t>(polygon[i])]; };
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Vec3 twice = cross(at(i - 1) - at(0), at(i) - at(0));
      area += 0.5 * twice;
      volume += dot(at(0), twice) / 6.0;
    }
  }
};

struct Named {
  std::string name;
  TriangleSurface surface;
  double spacing;
};

/// A cube with a cavity and a tunnel, both smaller than its cells.
TriangleSurface hollow_cube() {
  const std::vector<double> planes{0, 0.3, 0.34, 0.7, 0.75, 1};
  return grid_surface({{planes, planes, planes}}, [](int i, int j, int k) {
    const bool in_cavity = i == 1 && j == 1 && k == 1, in_tunnel = i == 3 && j == 3;
    return !in_cavity && !in_tunnel;
  });
}

TEST(SurfaceOutlines, PolyhedraFillTheirCells) {
  for (const Named& body : std::vector<Named>{{"hollow cube", hollow_cube(), 0.21},
                                              {"gear", gear_surface(9, 0.4, 1.0, 1.3, 0.5), 0.2},
                                              {"spikes", spiky_surface(3, 7, 14, 0.5), 0.25},
                                              {"plate", turned(box_surface({0, 0, 0}, {2, 1.5, 0.2}), 1.1), 0.2}})
    for (const double jitter : {0.0, 0.4}) {
      const SurfaceIndex index(body.surface);
      const std::vector<Vec3> points = lattice_in(index, body.spacing, jitter, 3);
      const SurfaceCells made = surface_cells(points, index, Moments::first, Pictures::wanted);
      std::vector<double> volume(points.size(), 0.0);
      for (const Polyhedron& p : made.polyhedra) {
        Measure measure;
        for (const std::vector<Index>& face : p.faces) measure.add(face, p.vertices);
        EXPECT_LE(norm(measure.area), 1e-13) << body.name << ", particle " << p.particle;
        volume[static_cast<std::size_t>(p.particle)] += measure.volume;
      }
      for (std::size_t a = 0; a < points.size(); ++a)
        EXPECT_NEAR(volume[a], made.cells.volume[a], 1e-13) << body.name << ", particle " << a;
    }
}

TEST(SurfaceOutlines, ArePicturesOnlyWhenWanted) {
  const TriangleSurface cube = box_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceIndex index(cube);
  EXPECT_TRUE(surface_cells(std::vector<Vec3>{{0.5, 0.5, 0.5}}, index).polyhedra.empty());
}

TEST(SurfaceOutlines, PolygonsWithHolesBecomeTriangles) {
  const std::vector<Vec3> places{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},   {1, 1, 0},
                                 {2, 1, 0}, {1, 2, 0}, {3, 3, 0}, {3.5, 3, 0}, {3, 3.5, 0}};
  const auto polygons = polygons_within({{0, 1, 2, 3}, {4, 6, 5}, {7, 9, 8}}, places, {0, 0, 1});
  Measure measure;
  for (const auto& polygon : polygons) {
    EXPECT_EQ(polygon.size(), 3U);
    Measure one;
    one.add(polygon, places);
    EXPECT_GT(one.area.z, 0.0);
    measure.add(polygon, places);
  }
  EXPECT_NEAR(measure.area.z, 16 - 0.5 - 0.125, 1e-14);
  EXPECT_EQ(polygons_within({{0, 1, 2, 3}}, places, {0, 0, 1}), (std::vector<std::vector<Index>>{{0, 1, 2, 3}}));
}

}  // namespace
}  // namespace tessera::test
