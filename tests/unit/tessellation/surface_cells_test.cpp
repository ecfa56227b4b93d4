#include "tessera/tessellation/surface_cells.hpp"

#include <gtest/gtest.h>

#include <map>

#include "surface_helpers.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera::test {
namespace {

struct Named {
  std::string name;
  TriangleSurface surface;
  double spacing;
};

TriangleSurface gear() { return gear_surface(9, 0.4, 1.0, 1.3, 0.5); }

/// A box with a slit from above whose left wall lies in bisectors of a lattice of spacing 1/4.
TriangleSurface slit_box(double width) {
  return grid_surface({{{0, 0.5, 0.5 + width, 1}, {0, 0.5, 1}, {0, 1}}},
                      [](int i, int j, int) { return i != 1 || j != 1; });
}

std::vector<Named> bodies() {
  return {{"ball", ball_surface(1.0, 12, 24), 0.3},
          {"fine ball", ball_surface(1.0, 40, 80), 0.4},
          {"torus", torus_surface(1.0, 0.4, 30, 12), 0.2},
          {"gear", gear(), 0.2},
          {"turned gear", turned(gear(), 0.7, {0.1, 0.2, 0.3}), 0.2},
          {"spikes", spiky_surface(3, 7, 14, 0.5), 0.25},
          {"plate", turned(box_surface({0, 0, 0}, {2, 1.5, 0.2}), 1.1), 0.2},
          {"box on the lattice", box_surface({-0.5, 0, 0}, {0.75, 1, 0.5}), 0.25},
          {"box through the lattice", box_surface({-0.5, 0.125, 0}, {0.75, 1, 0.625}), 0.25},
          {"slit", slit_box(0.02), 0.2},
          {"slit on the lattice", slit_box(1.0 / 32), 0.25}};
}

TEST(SurfaceCells, FillBodiesOfAnyShape) {
  for (const Named& body : bodies()) {
    const SurfaceIndex index(body.surface);
    for (const double jitter : {0.0, 0.25, 0.45})
      for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const std::vector<Vec3> points = lattice_in(index, body.spacing, jitter, seed);
        const std::string what = body.name + ", jitter " + std::to_string(jitter) + ", seed " + std::to_string(seed);
        expect_exact(surface_cells(points, index), points, body.surface, what);
        if (jitter == 0.0) break;
      }
  }
}

/// Particles as near to the surface as a ten-thousandth of their spacing.
TEST(SurfaceCells, FillBodiesWithParticlesAtTheirSurface) {
  for (const Named& body : bodies()) {
    const SurfaceIndex index(body.surface);
    std::vector<Vec3> points = lattice_in(index, body.spacing, 0.2, 5);
    std::size_t moved = 0;
    for (Vec3& X : points) {
      const NearestPoint nearest = index.nearest(X);
      if (nearest.distance > 0.5 * body.spacing || (++moved % 3) != 0) continue;
      X = nearest.X + (1e-4 * body.spacing / nearest.distance) * (X - nearest.X);
    }
    ASSERT_GT(moved, 5U) << body.name;
    expect_exact(surface_cells(points, index), points, body.surface, body.name);
  }
}

using FaceKey = std::pair<Index, Index>;

/// Area and first moment of all that counts, by what it belongs to.
std::map<FaceKey, std::pair<Vec3, Vec3>> listed(const Cells& cells) {
  std::map<FaceKey, std::pair<Vec3, Vec3>> faces;
  const auto add = [&](FaceKey key, const Vec3& area, const Vec3& centroid) {
    faces[key].first += area;
    faces[key].second += norm(area) * centroid;
  };
  for (const InteriorFace& f : cells.interior) add({f.a, f.b}, f.area, f.centroid);
  for (const BoundaryFace& f : cells.boundary) {
    const Vec3 N = normalized(f.area);
    const int axis = std::abs(N.x) > 0.5 ? 0 : (std::abs(N.y) > 0.5 ? 1 : 2);
    add({f.owner, -1 - 2 * axis - (N[axis] > 0.0)}, f.area, f.centroid);
  }
  return faces;
}

void expect_same(const Cells& cells, const Cells& expected, double size, const std::string& what) {
  const auto ours = listed(cells), theirs = listed(expected);
  const auto compare = [&](const auto& all, const auto& others) {
    for (const auto& [key, face] : all) {
      const auto other = others.find(key);
      const auto [area, moment] = other == others.end() ? std::pair<Vec3, Vec3>() : other->second;
      EXPECT_LE(norm(face.first - area), 1e-12 * size * size) << what << ' ' << key.first << ' ' << key.second;
      EXPECT_LE(norm(face.second - moment), 1e-12 * size * size * size)
          << what << ' ' << key.first << ' ' << key.second;
    }
  };
  compare(ours, theirs);
  compare(theirs, ours);
  for (std::size_t a = 0; a < expected.volume.size(); ++a) {
    EXPECT_NEAR(cells.volume[a], expected.volume[a], 1e-12 * size * size * size) << what;
    EXPECT_LE(norm(cells.centroid[a] - expected.centroid[a]), 1e-12 * size) << what;
  }
}

/// Convex pieces are cut by quite other means.
TEST(SurfaceCells, AreThoseOfConvexPieces) {
  struct Twice {
    std::string name;
    Solid solid;
    TriangleSurface surface;
  };
  const Solid cube = build_solid(box({0, 0, 0}, {1, 1, 1}));
  const std::vector<Twice> bodies{
      {"box", cube, box_surface({0, 0, 0}, {1, 1, 1})},
      {"L-block", build_solid(difference_of({box({0, 0, 0}, {1, 1, 1}), box({0.4, 0.5, -1}, {2, 2, 2})})),
       grid_surface({{{0, 0.4, 1}, {0, 0.5, 1}, {0, 1}}}, [](int i, int j, int) { return i == 0 || j == 0; })},
      {"hole", build_solid(hole()),
       grid_surface({{{0, 0.3, 0.6, 1}, {0, 0.3, 0.7, 1}, {0, 1}}},
                    [](int i, int j, int) { return i != 1 || j != 1; })},
      {"cavity", build_solid(cavity()),
       grid_surface({{{0, 0.3, 0.6, 1}, {0, 0.3, 0.7, 1}, {0, 0.4, 0.6, 1}}},
                    [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; })}};
  for (const Twice& body : bodies)
    for (const double jitter : {0.0, 0.1, 0.4})
      for (const std::uint64_t seed : {1U, 2U}) {
        const std::vector<Vec3> points = points_inside(body.solid, 0.125, jitter, seed);
        const SurfaceIndex index(body.surface);
        const SurfaceCells made = surface_cells(points, index);
        EXPECT_EQ(made.adopted, 0) << body.name;
        expect_same(made.cells, voronoi_cells(points, body.solid), 0.125, body.name + ' ' + std::to_string(jitter));
      }
}

/// A cavity and a hole much smaller than a cell, and a box of the size of a cell around a particle of its own.
TEST(SurfaceCells, HaveCavitiesHolesAndIslandsSmallerThanThemselves) {
  const std::vector<double> fine{0, 0.4, 0.45, 0.5, 0.55, 1};
  const auto is_core = [](int i) { return i == 2; };
  const auto is_shell = [](int i) { return i >= 1 && i <= 3; };
  std::vector<Vec3> without;  // with a bisector through the gap around the island on every side
  for (int d = 0; d < 3; ++d)
    for (const double way : {-0.1, 0.1}) {
      without.push_back({0.475, 0.475, 0.475});
      without.back()[d] += way;
    }
  std::vector<Vec3> points = without;
  points.push_back({0.476, 0.474, 0.475});
  const auto cells_of = [&](const std::vector<Vec3>& X, const std::function<bool(int, int, int)>& is_in) {
    const TriangleSurface surface = grid_surface({{fine, fine, fine}}, is_in);
    const SurfaceIndex index(surface);
    SurfaceCells made = surface_cells(X, index);
    expect_exact(made, X, surface, "cavity or hole");
    EXPECT_EQ(made.adopted, 0);
    return made.cells;
  };
  const double full = 1.0 - 0.15 * 0.15 * 0.15;
  const auto sum = [](const Cells& cells) {
    double V = 0.0;
    for (const double v : cells.volume) V += v;
    return V;
  };
  EXPECT_NEAR(sum(cells_of(without, [&](int i, int j, int k) { return !(is_shell(i) && is_shell(j) && is_shell(k)); })),
              full, 1e-14);
  const std::vector<Vec3> beside(without.begin(), without.begin() + 4);
  EXPECT_NEAR(sum(cells_of(beside, [&](int i, int j, int) { return !(is_shell(i) && is_shell(j)); })),
              1.0 - 0.15 * 0.15, 1e-14);
  const Cells island = cells_of(points, [&](int i, int j, int k) {
    return !(is_shell(i) && is_shell(j) && is_shell(k)) || (is_core(i) && is_core(j) && is_core(k));
  });
  EXPECT_NEAR(island.volume.back(), 0.05 * 0.05 * 0.05, 1e-16);
  EXPECT_NEAR(sum(island), full + 0.05 * 0.05 * 0.05, 1e-14);
}

TEST(SurfaceCells, HandPartsThatAreCutOffToTheirNeighbours) {
  // Beyond the slit, the cells of the particles beside it have ends that only their neighbours touch.
  const TriangleSurface surface = slit_box(0.02);
  const SurfaceIndex index(surface);
  const std::vector<Vec3> points = lattice_in(index, 0.2, 0.3, 1, 0.05);
  const SurfaceCells made = surface_cells(points, index);
  EXPECT_GT(made.adopted, 0);
  EXPECT_GT(made.adopted_volume, 1e-5);
  EXPECT_TRUE(std::any_of(made.cells.interior.begin(), made.cells.interior.end(),
                          [](const InteriorFace& f) { return !f.bisects; }));
  expect_exact(made, points, surface, "slit");
  int above = 0;
  for (const InteriorFace& f : made.cells.interior) {  // far above its end, nothing reaches across
    const Vec3 &X_a = points[static_cast<std::size_t>(f.a)], &X_b = points[static_cast<std::size_t>(f.b)];
    if (std::min(X_a.y, X_b.y) < 0.75) continue;
    EXPECT_GT((X_a.x - 0.51) * (X_b.x - 0.51), 0.0);
    ++above;
  }
  EXPECT_GT(above, 20);
}

std::string message(const std::vector<Vec3>& points, const TriangleSurface& surface) {
  const SurfaceIndex index(surface);
  try {
    surface_cells(points, index);
  } catch (const GeometryError& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceCells, RefuseWhatTheyCannotFill) {
  const TriangleSurface cube = box_surface({0, 0, 0}, {1, 1, 1});
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(message({}, cube), "no particles");
  has(message({{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, cube), "particle 1 at (1.5, 0.5, 0.5) m does not lie inside");
  has(message({{0.5, 0.5, 0.5}, {1.0, 0.5, 0.5}}, cube), "particle 1");
  has(message({{0.5, 0.5, 0.5}, {0.2, 0.5, 0.5}, {0.5, 0.5, 0.5}}, cube), "coincide");

  const TriangleSurface two = grid_surface({{{0, 1, 2, 4}, {0, 1}, {0, 1}}}, [](int i, int, int) { return i != 1; });
  has(message({{0.5, 0.5, 0.5}}, two), "more than half of the cell");
  const TriangleSurface small =
      grid_surface({{{0, 1, 2, 2.1}, {0, 1}, {0, 1}}}, [](int i, int, int) { return i != 1; });
  has(message({{0.2, 0.5, 0.5}, {0.6, 0.5, 0.5}}, small), "and from all others");

  // A comb with a particle in one tooth only.
  const TriangleSurface comb =
      grid_surface({{{0, 1, 1.1, 3}, {0, 0.1, 2}, {0, 1}}}, [](int i, int j, int) { return j == 0 || i != 1; });
  has(message({{0.5, 1.5, 0.5}, {0.5, 0.5, 0.5}}, comb), "particle 0 at (0.5, 1.5, 0.5) m");
}

TEST(SurfaceCells, AreTheSameForAnyNumberOfThreads) {
  const TriangleSurface surface = turned(slit_box(0.02), 0.7);
  const SurfaceIndex index(surface);
  const std::vector<Vec3> points = lattice_in(index, 0.07, 0.3, 1, 0.02);
  ASSERT_GT(static_cast<std::int64_t>(points.size()), 2 * parallel::block_size);
  const int before = parallel::threads();
  parallel::set_threads(1);
  const SurfaceCells one = surface_cells(points, index);
  parallel::set_threads(3);
  const SurfaceCells many = surface_cells(points, index);
  parallel::set_threads(before);
  EXPECT_GT(one.adopted, 0);
  EXPECT_EQ(one.cells.volume, many.cells.volume);
  EXPECT_EQ(one.cells.centroid, many.cells.centroid);
  ASSERT_EQ(one.cells.interior.size(), many.cells.interior.size());
  for (std::size_t i = 0; i < one.cells.interior.size(); ++i) {
    EXPECT_EQ(one.cells.interior[i].area, many.cells.interior[i].area);
    EXPECT_EQ(one.cells.interior[i].centroid, many.cells.interior[i].centroid);
  }
}

/// Rotating the case may change digits, but not what is found.
TEST(SurfaceCells, TurnWithTheBody) {
  const TriangleSurface surface = gear();
  const SurfaceIndex index(surface);
  const std::vector<Vec3> points = lattice_in(index, 0.2, 0.3, 2);
  const TriangleSurface other = turned(surface, 0.4);
  TriangleSurface carrier;
  carrier.vertices = points;
  const std::vector<Vec3> moved = turned(carrier, 0.4).vertices;
  const Cells here = surface_cells(points, index).cells, there = surface_cells(moved, SurfaceIndex(other)).cells;
  for (std::size_t a = 0; a < points.size(); ++a) EXPECT_NEAR(here.volume[a], there.volume[a], 1e-12);
  ASSERT_EQ(here.interior.size(), there.interior.size());
  for (std::size_t i = 0; i < here.interior.size(); ++i)
    EXPECT_NEAR(norm(here.interior[i].area), norm(there.interior[i].area), 1e-12);
}

/// Thin cells between particles that nearly coincide are mostly round-off of their distance from the origin; that is
/// no crack in the surface.
TEST(SurfaceCells, ThinCellsFarFromTheOriginClose) {
  TriangleSurface points;
  for (const double z : {0.3, 0.5 - 1e-7, 0.5, 0.5 + 1e-7, 0.7}) points.vertices.push_back({0.4, 0.6, z});
  const Vec3 away{1000.3, 1700.7, -800.1};
  const std::vector<Vec3> X = turned(points, 0.7, away).vertices;
  const TriangleSurface surface = turned(box_surface({0, 0, 0}, {1, 1, 1}), 0.7, away);
  Solid solid;
  solid.volume = volume(surface);
  const Residuals r = residuals(surface_cells(X, SurfaceIndex(surface)).cells, X, solid);
  EXPECT_LE(r.closure, 1e-12);
  EXPECT_LE(r.total, 1e-12);
}

/// Cells no thicker than a billionth of the spacing, whose volumes are known to a few digits: they still close, and all
/// fill the solid.
TEST(SurfaceCells, ThinCellsAtTheSurfaceClose) {
  for (const double angle : {0.0, 0.3, 0.7, 1.1}) {
    TriangleSurface points;
    points.vertices = {{-0.2, 0, -0.2}, {0, 0, -0.25 + 2e-10}, {0, 0, -0.25 + 1e-9}, {0.1, 0.2, -0.25 + 5e-10}};
    const std::vector<Vec3> X = turned(points, angle).vertices;
    for (const TriangleSurface& straight :
         {box_surface({-0.5, -0.5, -0.25}, {0.5, 0.5, 0.25}), torus_surface(0.2, 0.25, 12, 8)}) {
      const TriangleSurface surface = turned(straight, angle);
      const SurfaceIndex index(surface);
      const auto outside = [&](const Vec3& Y) { return index.location(Y) != Location::inside; };
      if (std::any_of(X.begin(), X.end(), outside)) continue;
      Solid solid;
      solid.volume = volume(surface);
      const Residuals r = residuals(surface_cells(X, index).cells, X, solid);
      EXPECT_LE(r.closure, 1e-12) << angle;
      EXPECT_LE(r.total, 1e-12) << angle;
    }
  }
}

}  // namespace
}  // namespace tessera::test
