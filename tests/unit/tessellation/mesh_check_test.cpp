#include <gtest/gtest.h>

#include <limits>

#include "mesh_helpers.hpp"
#include "tessera/geometry/mesh_file.hpp"
#include "tessera/tessellation/mesh_check.hpp"

namespace tessera::test {
namespace {

/// Two tetrahedra with the common face (1, 2, 3); nodes are numbered from 10, elements from 100, lines from 1000.
FileMesh pair_of_tetrahedra() {
  FileMesh file;
  file.path = "pair.msh";
  file.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  file.point_numbers = {10, 11, 12, 13, 14};
  file.tetrahedra = {{{0, 1, 2, 3}, 100, 1000}, {{1, 2, 3, 4}, 101, 1001}};
  return file;
}

FileTriangle triangle(const Triangle& vertices, int surface) { return {{vertices, 200, 2000}, surface}; }

std::string refusal(const FileMesh& file) {
  return geometry_error([&] { checked_mesh(file); });
}

TEST(MeshCheck, SoundPairPasses) {
  const TetrahedralMesh mesh = checked_mesh(pair_of_tetrahedra());
  expect_sound(mesh);
  EXPECT_EQ(mesh.boundary.size(), 6u);
  EXPECT_NEAR(volume_of(mesh), 1.0 / 6.0 + 1.0 / 3.0, 1e-15);
  for (const BoundaryTriangle& t : mesh.boundary) EXPECT_EQ(t.side, -1);
}

TEST(MeshCheck, InvertedElementIsNamedNotFlipped) {
  FileMesh file = pair_of_tetrahedra();
  std::swap(file.tetrahedra[1].vertices[0], file.tetrahedra[1].vertices[1]);
  expect_contains(refusal(file),
                  {"pair.msh:1001: element 101 (nodes 12, 11, 13, 14)", "inverted", "-0.333", "swap two of its nodes"});
}

TEST(MeshCheck, FlatElementIsNamed) {
  FileMesh file = pair_of_tetrahedra();
  file.points[3] = {0.2, 0.2, 1e-14};
  expect_contains(refusal(file), {"pair.msh:1000: element 100 (nodes 10, 11, 12, 13)", "flat"});
}

TEST(MeshCheck, ElementWithOneNodeTwiceIsNamed) {
  FileMesh file = pair_of_tetrahedra();
  file.tetrahedra.push_back({{0, 1, 1, 2}, 102, 1002});
  expect_contains(refusal(file), {"pair.msh:1002: element 102 (nodes 10, 11, 11, 12) has one node twice"});
}

TEST(MeshCheck, BinaryFilesGiveTheByte) {
  FileMesh file = pair_of_tetrahedra();
  file.unit = PlaceUnit::byte;
  std::swap(file.tetrahedra[0].vertices[0], file.tetrahedra[0].vertices[1]);
  expect_contains(refusal(file), {"pair.msh: byte 1000: element 100"});
}

TEST(MeshCheck, IsolatedNodesAreCountedAndTheFirstIsNamed) {
  FileMesh file = pair_of_tetrahedra();
  file.points.insert(file.points.end(), {{7, 8, 9}, {9, 9, 9}});
  file.point_numbers.insert(file.point_numbers.end(), {15, 16});
  expect_contains(refusal(file),
                  {"pair.msh: 2 of 7 nodes belong to no tetrahedron", "node 15 at (7, 8, 9)", "physical group"});
}

TEST(MeshCheck, DoubledNodesAreNamed) {
  FileMesh file = pair_of_tetrahedra();
  file.points.push_back(file.points[1] + Vec3{0, 1e-11, 0});
  file.point_numbers.push_back(15);
  file.tetrahedra[1].vertices[0] = 5;
  expect_contains(refusal(file),
                  {"pair.msh: node 11 at (1, 0, 0) and node 15 at (1, 1e-11, 0) are the same point", "merge"});
}

TEST(MeshCheck, PositionsThatAreNotFiniteAreNamed) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    FileMesh file = pair_of_tetrahedra();
    file.points[2].y = bad;
    expect_contains(refusal(file), {"pair.msh: node 12", "not a finite position"});
  }
}

TEST(MeshCheck, OverlappingElementsAreNamed) {
  FileMesh file = pair_of_tetrahedra();
  file.points[0] = {2, 2, 2};
  file.tetrahedra[0].vertices = {1, 2, 3, 0};
  expect_contains(refusal(file),
                  {"pair.msh:1000: element 100", "and element 101 lie on the same side of one face", "overlap"});
}

TEST(MeshCheck, FaceOfThreeElementsIsRefused) {
  FileMesh file = pair_of_tetrahedra();
  file.points.push_back({2, 2, 2});
  file.point_numbers.push_back(15);
  file.tetrahedra.push_back({{1, 2, 3, 5}, 102, 1002});
  expect_contains(refusal(file), {"element 100", "and elements 101, 102 use one face", "conforming"});
}

TEST(MeshCheck, PartsThatTouchInAnEdgeOnlyAreRefused) {
  FileMesh file = pair_of_tetrahedra();
  file.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  file.point_numbers = {10, 11, 12, 13, 14, 15};
  file.tetrahedra[1].vertices = {0, 1, 4, 5};
  expect_contains(refusal(file), {"touch only in the edge between node 10 at (0, 0, 0) and node 11 at (1, 0, 0)"});
}

TEST(MeshCheck, FileWithoutTetrahedraIsRefused) {
  FileMesh file = pair_of_tetrahedra();
  file.tetrahedra.clear();
  expect_contains(refusal(file), {"pair.msh: holds no tetrahedra", "physical group"});
}

TEST(MeshCheck, NamedTriangleOfAnotherMeshIsNamed) {
  FileMesh file = pair_of_tetrahedra();
  file.triangles = {triangle({0, 1, 4}, 5)};
  expect_contains(refusal(file), {"pair.msh:2000: element 200 (nodes 10, 11, 14)", "no face of a tetrahedron"});
}

TEST(MeshCheck, SurfacesBecomeSidesWhateverTheirTrianglesOrientation) {
  FileMesh file = pair_of_tetrahedra();
  file.surfaces = {{5, "foot"}, {6, "left"}};
  file.triangles = {triangle({0, 1, 2}, 5), triangle({3, 1, 0}, 6), triangle({3, 0, 1}, 5), triangle({1, 2, 3}, 6)};
  const TetrahedralMesh mesh = checked_mesh(file);
  const std::vector<std::vector<std::string>> expected{{"foot"}, {"foot", "left"}};
  EXPECT_EQ(mesh.side_names, expected);
  expect_near(area_of(mesh, "foot"), {0, -0.5, -0.5}, 1e-15);
  expect_near(area_of(mesh, "left"), {0, -0.5, 0}, 1e-15);
}

}  // namespace
}  // namespace tessera::test
