#include <gtest/gtest.h>

#include <map>
#include <set>

#include "voronoi_helpers.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <voro++/voro++.hh>
#pragma GCC diagnostic pop

namespace tessera {
namespace {

using namespace test;

/// An independent implementation (voro++, Rycroft 2009), which knows boxes.
TEST(VoronoiReference, VoroppFindsTheSameCellsInABox) {
  const Solid solid = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const std::vector<Vec3> points = points_of(lattice(0.1, 0.45, 8), solid);
  const Cells cells = voronoi_cells(points, solid);
  std::map<std::pair<int, int>, double> area;
  for (const InteriorFace& face : cells.interior) area[{face.a, face.b}] = norm(face.area);

  voro::container container(0, 1, 0, 1, 0, 1, 6, 6, 6, false, false, false, 8);
  for (std::size_t p = 0; p < points.size(); ++p)
    container.put(static_cast<int>(p), points[p].x, points[p].y, points[p].z);
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  ASSERT_TRUE(loop.start());
  do {
    ASSERT_TRUE(container.compute_cell(cell, loop));
    const int a = loop.pid();
    const Vec3& X = points[static_cast<std::size_t>(a)];
    Vec3 centroid;
    cell.centroid(centroid.x, centroid.y, centroid.z);
    EXPECT_NEAR(cells.volume[static_cast<std::size_t>(a)], cell.volume(), 1e-14);
    EXPECT_NEAR(norm(cells.centroid[static_cast<std::size_t>(a)] - X - centroid), 0, 1e-13);
    std::vector<int> neighbours;
    std::vector<double> areas;
    cell.neighbors(neighbours);
    cell.face_areas(areas);
    for (std::size_t f = 0; f < neighbours.size(); ++f) {
      if (neighbours[f] < a) continue;
      const auto face = area.find({a, neighbours[f]});
      ASSERT_TRUE(face != area.end() || areas[f] < 1e-14);
      if (face == area.end()) continue;
      EXPECT_NEAR(face->second, areas[f], 1e-13);
      area.erase(face);
    }
  } while (loop.inc());
  for (const auto& [pair, size] : area) EXPECT_LT(size, 1e-13);  // nothing that voro++ does not have
}

/// Any point of the solid belongs to the cell of the nearest particle: volumes by counting sample points.
TEST(VoronoiReference, VolumesAgreeWithNearestParticles) {
  const Solid solid = build_solid(l_polygon());
  const std::vector<Vec3> points = points_of(lattice(1.5, 0.4, 3), solid);
  const Cells cells = voronoi_cells(points, solid);
  std::vector<double> counted(points.size(), 0.0);
  const double h = 0.075;
  for (const Vec3& X : points_of(lattice(h), solid)) {
    const auto nearest = std::min_element(points.begin(), points.end(),
                                          [&](const Vec3& a, const Vec3& b) { return norm2(a - X) < norm2(b - X); });
    counted[static_cast<std::size_t>(nearest - points.begin())] += h * h * h;
  }
  for (std::size_t p = 0; p < points.size(); ++p) EXPECT_NEAR(counted[p], cells.volume[p], 0.02 * cells.volume[p]);
}

/// B_ab = (A/L)(C - X_a) = -dV_b/dX_a ([V 7], [V 61]), by central differences of the volumes.
TEST(VoronoiReference, GradientVectorsAreDerivativesOfVolumes) {
  for (const Shape& shape :
       {box({0, 0, 0}, {1, 1, 1}), polygon({{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}, 1.0)}) {
    const Solid solid = build_solid(shape);
    std::vector<Vec3> points = points_of(lattice(0.25, 0.3, 4), solid);
    const Cells cells = voronoi_cells(points, solid);
    const double step = 1e-5;
    for (const Index a : {0, 7, 20, 29, 33}) {
      std::map<Index, Vec3> B;
      const Vec3 X = points[static_cast<std::size_t>(a)];
      for (const InteriorFace& face : cells.interior) {
        if (face.a != a && face.b != a) continue;
        const Index b = face.a == a ? face.b : face.a;
        const double L = norm(points[static_cast<std::size_t>(b)] - X);
        B[b] = (norm(face.area) / L) * (face.centroid - X);
      }
      for (int d = 0; d < 3; ++d) {
        points[static_cast<std::size_t>(a)][d] = X[d] + step;
        const std::vector<double> plus = voronoi_cells(points, solid).volume;
        points[static_cast<std::size_t>(a)][d] = X[d] - step;
        const std::vector<double> minus = voronoi_cells(points, solid).volume;
        points[static_cast<std::size_t>(a)] = X;
        for (Index b = 0; b < static_cast<Index>(points.size()); ++b) {
          if (b == a) continue;
          const double derivative =
              (plus[static_cast<std::size_t>(b)] - minus[static_cast<std::size_t>(b)]) / (2 * step);
          EXPECT_NEAR(-derivative, B.count(b) ? B[b][d] : 0.0, 1e-8) << a << " " << b << " " << d;
        }
      }
    }
  }
}

/// The polyhedra are the cells: same volumes, faces that fit together, vertices shared by neighbours to the bit.
TEST(VoronoiReference, PolyhedraFillTheCells) {
  const Solid solid = build_solid(star());
  const std::vector<Vec3> points = points_inside(solid, 0.35, 0.4, 1);
  const Cells cells = voronoi_cells(points, solid);
  std::vector<double> volume(points.size(), 0.0);
  std::set<std::array<double, 3>> distinct;
  std::size_t corners = 0;
  Index before = 0;
  for (const Polyhedron& part : voronoi_polyhedra(points, solid)) {
    EXPECT_GE(part.particle, before);
    before = part.particle;
    std::map<std::pair<Index, Index>, int> edges;
    for (const std::vector<Index>& face : part.faces) {
      ASSERT_GE(face.size(), 3U);
      const auto at = [&](std::size_t i) { return part.vertices[static_cast<std::size_t>(face[i % face.size()])]; };
      for (std::size_t i = 0; i < face.size(); ++i) ++edges[{face[i], face[(i + 1) % face.size()]}];
      for (std::size_t i = 1; i + 1 < face.size(); ++i)
        volume[static_cast<std::size_t>(part.particle)] += dot(at(0), cross(at(i), at(i + 1))) / 6.0;
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
    for (const Vec3& X : part.vertices) distinct.insert({X.x, X.y, X.z});
    corners += part.vertices.size();
  }
  for (std::size_t p = 0; p < points.size(); ++p) EXPECT_NEAR(volume[p], cells.volume[p], 1e-13);
  EXPECT_LT(static_cast<double>(distinct.size()), 0.4 * static_cast<double>(corners));
}

}  // namespace
}  // namespace tessera
