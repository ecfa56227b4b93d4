#include "tessera/geometry/surface_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "shapes.hpp"
#include "support/surfaces.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {
namespace {

using test::ball_surface;
using test::box_surface;
using test::expect_contains;
using test::message_of;

FileSurface file_of(TriangleSurface surface) {
  FileSurface file{"part.stl", PlaceUnit::line, std::move(surface), {}};
  for (Index t = 0; t < file.surface.size(); ++t) file.place.push_back(7 * t + 2);
  return file;
}

/// As an STL file has it: every triangle with vertices of its own, in a random order.
TriangleSurface soup_of(const TriangleSurface& surface, unsigned seed, double noise = 0.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-noise, noise);
  std::vector<Index> order(surface.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  TriangleSurface soup;
  soup.side_names = surface.side_names;
  for (const Index t : order) {
    const auto first = static_cast<Index>(soup.vertices.size());
    for (const Vec3& X : surface.corners(t)) soup.vertices.push_back(X + Vec3{off(random), off(random), off(random)});
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.side.push_back(surface.side[static_cast<std::size_t>(t)]);
  }
  return soup;
}

TriangleSurface both(TriangleSurface a, const TriangleSurface& b) {
  const auto vertices = static_cast<Index>(a.vertices.size()), sides = static_cast<Index>(a.side_names.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
  for (const Index s : b.side) a.side.push_back(s + sides);
  for (const std::string& name : b.side_names) a.side_names.push_back("other " + name);
  return a;
}

TriangleSurface turned(TriangleSurface surface) {
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

TriangleSurface moved(TriangleSurface surface, const Vec3& by) {
  for (Vec3& X : surface.vertices) X += by;
  return surface;
}

void erase_triangle(TriangleSurface& surface, std::ptrdiff_t t) {
  surface.triangles.erase(surface.triangles.begin() + t);
  surface.side.erase(surface.side.begin() + t);
}

void add_triangle(TriangleSurface& surface, const Triangle& t) {
  surface.triangles.push_back(t);
  surface.side.push_back(0);
}

std::string fault_of(const TriangleSurface& surface) {
  return message_of<GeometryError>([&] { check_surface(file_of(surface)); });
}

TEST(SurfaceCheck, GoodSurfacesPassUnchanged) {
  for (const TriangleSurface& surface : {box_surface({0, 0, 0}, {3, 2, 1}), ball_surface(2, 12, 16),
                                         test::torus_surface(2, 1, 12, 9), test::spiky_surface(4, 12, 18, 0.05)}) {
    const CheckedSurface checked = check_surface(file_of(surface));
    EXPECT_FALSE(checked.repairs.any());
    EXPECT_EQ(checked.shells, 1);
    EXPECT_EQ(checked.cavities, 0);
    EXPECT_EQ(checked.surface.vertices, surface.vertices);
    EXPECT_EQ(checked.surface.triangles, surface.triangles);
    EXPECT_EQ(checked.surface.side, surface.side);
    EXPECT_EQ(checked.surface.side_names, surface.side_names);
  }
}

TEST(SurfaceCheck, WeldsTheVerticesOfASoup) {
  const TriangleSurface ball = ball_surface(1, 20, 30);
  for (const double noise : {0.0, 2e-8}) {
    const CheckedSurface checked = check_surface(file_of(soup_of(ball, 1, noise)));
    EXPECT_EQ(checked.surface.vertices.size(), ball.vertices.size());
    EXPECT_EQ(checked.surface.triangles.size(), ball.triangles.size());
    EXPECT_EQ(checked.repairs.moved_vertices > 0, noise > 0);
    EXPECT_NEAR(volume(checked.surface), volume(ball), noise > 0 ? 1e-6 : 1e-14);
    EXPECT_TRUE(test::is_closed(checked.surface));
  }
}

TEST(SurfaceCheck, DropsFlatAndDoubledTriangles) {
  TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  add_triangle(box, {0, 0, 1});
  add_triangle(box, {3, 3, 3});
  add_triangle(box, {6, 2, 0});  // the second triangle again
  const CheckedSurface checked = check_surface(file_of(box));
  EXPECT_EQ(checked.repairs.flat_triangles, 2);
  EXPECT_EQ(checked.repairs.doubled_triangles, 1);
  EXPECT_EQ(checked.surface.size(), 12);
  EXPECT_DOUBLE_EQ(volume(checked.surface), 1);
}

TEST(SurfaceCheck, PartsThatShareAWallBecomeOne) {
  // The walls in x = 1 are cut along the same diagonals only when one box is the mirror image of the other.
  TriangleSurface mirrored = box_surface({0, 0, 0}, {1, 1, 1});
  for (Vec3& X : mirrored.vertices) X.x = 2 - X.x;
  const CheckedSurface checked = check_surface(file_of(both(box_surface({0, 0, 0}, {1, 1, 1}), turned(mirrored))));
  EXPECT_EQ(checked.repairs.back_to_back, 2);
  EXPECT_EQ(checked.surface.size(), 20);
  EXPECT_EQ(checked.shells, 1);
  EXPECT_DOUBLE_EQ(volume(checked.surface), 2);
}

TEST(SurfaceCheck, FacesWithTwoSidesKeepOne) {
  TriangleSurface ball = ball_surface(1, 6, 8);
  for (const std::size_t t : {0u, 1u, 2u, 20u, 21u, 40u}) {
    const Triangle old = ball.triangles[t];
    add_triangle(ball, {old[0], old[2], old[1]});
  }
  const CheckedSurface some = check_surface(file_of(ball));
  EXPECT_EQ(some.repairs.doubled_triangles, 6);
  EXPECT_EQ(some.repairs.back_to_back, 0);
  EXPECT_NEAR(volume(some.surface), volume(ball_surface(1, 6, 8)), 1e-14);

  TriangleSurface all = ball_surface(1, 6, 8);
  all = both(all, turned(all));
  EXPECT_NEAR(volume(check_surface(file_of(all)).surface), volume(ball_surface(1, 6, 8)), 1e-14);
}

TEST(SurfaceCheck, SplitsTrianglesAtVerticesOnTheirEdges) {
  TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  // The edge from vertex 0 to 1 gets two more vertices, which only the bottom knows.
  box.vertices.push_back({0.25, 0, 0});
  box.vertices.push_back({0.75, 0, 0});
  const auto old = std::find(box.triangles.begin(), box.triangles.end(), Triangle{0, 3, 1}) - box.triangles.begin();
  ASSERT_LT(old, 12);
  erase_triangle(box, old);
  for (const Triangle& t : {Triangle{0, 3, 8}, Triangle{8, 3, 9}, Triangle{9, 3, 1}}) add_triangle(box, t);
  const CheckedSurface checked = check_surface(file_of(box));
  EXPECT_EQ(checked.repairs.split_triangles, 1);
  EXPECT_EQ(checked.surface.size(), 16);
  EXPECT_TRUE(test::is_closed(checked.surface));
  EXPECT_DOUBLE_EQ(volume(checked.surface), 1);
}

TEST(SurfaceCheck, ReplacesTrianglesWithThreeVerticesInALine) {
  TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  box.vertices.push_back({0.5, 0, 0});
  const auto old = std::find(box.triangles.begin(), box.triangles.end(), Triangle{0, 3, 1}) - box.triangles.begin();
  erase_triangle(box, old);
  for (const Triangle& t : {Triangle{0, 3, 8}, Triangle{8, 3, 1}, Triangle{0, 8, 1}}) add_triangle(box, t);
  const CheckedSurface checked = check_surface(file_of(box));
  EXPECT_EQ(checked.repairs.flat_triangles, 1);
  EXPECT_EQ(checked.repairs.split_triangles, 1);
  EXPECT_EQ(checked.surface.size(), 14);
  EXPECT_DOUBLE_EQ(volume(checked.surface), 1);
}

TEST(SurfaceCheck, TurnsFewContraryTriangles) {
  TriangleSurface ball = ball_surface(1, 12, 16);
  for (const std::size_t t : {3u, 50u, 51u, 52u, 200u}) std::swap(ball.triangles[t][1], ball.triangles[t][2]);
  const CheckedSurface checked = check_surface(file_of(ball));
  EXPECT_EQ(checked.repairs.turned_triangles, 5);
  EXPECT_TRUE(test::is_closed(checked.surface));
  EXPECT_NEAR(volume(checked.surface), volume(ball_surface(1, 12, 16)), 1e-14);
}

TEST(SurfaceCheck, RefusesManyContraryTriangles) {
  TriangleSurface ball = ball_surface(1, 12, 16);
  for (std::size_t t = 0; t < ball.triangles.size(); t += 3) std::swap(ball.triangles[t][1], ball.triangles[t][2]);
  const std::string message = fault_of(ball);
  expect_contains(message, "118 of 352");
  expect_contains(message, "orient");
}

TEST(SurfaceCheck, RefusesHolesWithPlaceAndLength) {
  TriangleSurface box = box_surface({0, 0, 0}, {1, 2, 4});
  erase_triangle(box, 2);  // 1, 3, 7: half of the side +x
  const std::string message = fault_of(box);
  expect_contains(message, "part.stl: the surface is not closed: it has a hole around (1, ");
  expect_contains(message, "3 open edges");
  expect_contains(message, "10.47 long");  // 2 + 4 + sqrt(20)
  expect_contains(message, "(line ");
  erase_triangle(box, 0);
  expect_contains(fault_of(box), "2 holes");
}

TEST(SurfaceCheck, RefusesInsideOut) {
  const std::string message = fault_of(turned(ball_surface(1, 8, 8)));
  expect_contains(message, "inside out");
  expect_contains(message, "flip the normals");
  // One that is right does not hide one that is wrong.
  expect_contains(fault_of(both(ball_surface(1, 8, 8), moved(turned(ball_surface(1, 8, 8)), {3, 0, 0}))), "inside out");
}

TEST(SurfaceCheck, CavitiesAreAllowedAndDoubleShellsAreNot) {
  const TriangleSurface outer = ball_surface(2, 10, 10), inner = ball_surface(1, 8, 8);
  const CheckedSurface hollow = check_surface(file_of(both(outer, turned(inner))));
  EXPECT_EQ(hollow.shells, 1);
  EXPECT_EQ(hollow.cavities, 1);
  EXPECT_NEAR(volume(hollow.surface), volume(outer) - volume(inner), 1e-13);
  expect_contains(fault_of(both(outer, inner)), "lies within another");
  // A ball in the cavity of a ball.
  const CheckedSurface onion = check_surface(file_of(both(both(outer, turned(inner)), ball_surface(0.5, 6, 6))));
  EXPECT_EQ(onion.shells, 2);
  EXPECT_EQ(onion.cavities, 1);
}

TEST(SurfaceCheck, RefusesSelfIntersectionWithPlace) {
  const std::string message =
      fault_of(both(box_surface({0, 0, 0}, {1, 1, 1}), box_surface({0.5, 0.5, 0.5}, {2, 2, 2})));
  expect_contains(message, "cuts itself at (");
  expect_contains(message, "pairs");
  expect_contains(message, "unite");
  // A vertex that pushes through the opposite side.
  TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  box.vertices[7] = {-0.5, 0.4, 0.3};
  expect_contains(fault_of(box), "cuts itself");
  // A corner that only just touches a face from outside, and one that stays away by the least that can be told.
  TriangleSurface apart = both(box_surface({0, 0, 0}, {1, 1, 1}), ball_surface(1, 2, 4));
  for (std::size_t v = 8; v < apart.vertices.size(); ++v) apart.vertices[v] += Vec3{0.5, 0.5, 2.0};
  const double lowest = apart.vertices[8].z;
  EXPECT_EQ(lowest, 1.0);
  expect_contains(fault_of(apart), "cuts itself at (0.5, 0.5, 1)");
  apart.vertices[8].z = std::nextafter(1.0, 2.0);
  EXPECT_EQ(check_surface(file_of(apart)).shells, 2);
}

TEST(SurfaceCheck, RefusesFoldsAndFacesWithin) {
  TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  for (const Triangle& t : {Triangle{0, 3, 7}, Triangle{0, 7, 4}}) add_triangle(box, t);
  expect_contains(fault_of(box), "3 triangles meet at the edge from (0, 0, 0)");
}

TEST(SurfaceCheck, BodiesMayTouchAlongEdgesAndAtVertices) {
  const TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(volume(check_surface(file_of(both(box, moved(box, {1, 1, 0})))).surface), 2);
  EXPECT_EQ(check_surface(file_of(both(box, moved(box, {1, 1, 1})))).shells, 2);
  // The same with one of them inside out: the edge itself tells.
  expect_contains(fault_of(both(box, turned(moved(box, {1, 1, 0})))), "4 triangles meet at the edge");
  expect_contains(fault_of(both(box, turned(moved(box, {1, 1, 1})))), "inside out");
}

TEST(SurfaceCheck, RefusesOneSidedSurfaces) {
  // A Moebius strip of five squares, and a lid would not help.
  TriangleSurface strip;
  constexpr int n = 5;
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * std::numbers::pi * i / n;
    for (const double h : {-0.3, 0.3}) {
      const double r = 2 + h * std::cos(phi / 2);
      strip.vertices.push_back({r * std::cos(phi), r * std::sin(phi), h * std::sin(phi / 2)});
    }
  }
  for (int i = 0; i < n; ++i) {
    Index a = 2 * i, b = 2 * i + 1, c = (2 * i + 2) % (2 * n), d = (2 * i + 3) % (2 * n);
    if (i == n - 1) std::swap(c, d);
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  FileSurface file = file_of(test::with_one_side(strip));
  SurfaceRepairs repairs;
  expect_contains(message_of<GeometryError>([&] { turn_contrary_triangles(file, repairs); }), "one side only");
  expect_contains(fault_of(file.surface), "not closed");
}

TEST(SurfaceCheck, RefusesNothingAndBadNumbers) {
  expect_contains(fault_of({}), "holds no triangle");
  TriangleSurface box = box_surface({0, 0, 0}, {1, 1, 1});
  box.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  expect_contains(fault_of(box), "nan");
  box.vertices[3].y = 1e60;
  expect_contains(fault_of(box), "1e+60");
  for (Vec3& X : box.vertices) X = {1, 1, 1};
  expect_contains(fault_of(box), "holds no triangle");
}

TEST(SurfaceCheck, ResultDoesNotDependOnTheNumberOfThreads) {
  TriangleSurface spiky = test::spiky_surface(8, 30, 40, 0.2);
  for (std::size_t v = 0; v < spiky.vertices.size(); v += 97) spiky.vertices[v] = -1.0 * spiky.vertices[v];
  const int before = parallel::threads();
  std::vector<std::string> messages;
  for (const int threads : {1, 2, 3}) {
    parallel::set_threads(threads);
    messages.push_back(fault_of(spiky));
  }
  parallel::set_threads(before);
  EXPECT_EQ(messages[0], messages[1]);
  EXPECT_EQ(messages[0], messages[2]);
  expect_contains(messages[0], "cuts itself");
}

}  // namespace
}  // namespace tessera
