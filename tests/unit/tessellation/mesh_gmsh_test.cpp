#include <gtest/gtest.h>

#include <cstring>

#include "mesh_helpers.hpp"
#include "tessera/geometry/gmsh.hpp"

namespace tessera::test {
namespace {

std::string refusal(const std::string& bytes) {
  return geometry_error([&] { read_gmsh("part.msh", bytes); });
}

template <class T>
std::string binary(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

const std::string format_22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string format_41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes_22 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n30 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string tetrahedron_22 = "$Elements\n1\n9 4 2 3 1 1 2 30 4\n$EndElements\n";

TEST(Gmsh22, NumbersNeedNotBeConsecutiveAndWindowsLineEndsPass) {
  const std::string text = format_22 + "$Comments\nanything $Nodes\n$EndComments\n" + nodes_22 + tetrahedron_22;
  std::string bytes;
  for (const char c : text) {
    if (c == '\n') bytes.push_back('\r');
    bytes.push_back(c);
  }
  const FileMesh mesh = read_gmsh("part.msh", bytes);
  EXPECT_EQ(mesh.point_numbers, (std::vector<std::int64_t>{1, 2, 30, 4}));
  ASSERT_EQ(mesh.tetrahedra.size(), 1u);
  EXPECT_EQ(mesh.tetrahedra[0].vertices, (Tetrahedron{0, 1, 2, 3}));
  EXPECT_EQ(mesh.tetrahedra[0].number, 9);
  EXPECT_EQ(mesh.tetrahedra[0].place, 16);
}

TEST(Gmsh22, TriangleOfTwoSurfacesIsTakenTwiceAndOneOfNoneIsNot) {
  const FileMesh mesh =
      read_gmsh("part.msh", format_22 + "$PhysicalNames\n2\n2 7 \"a b\"\n3 7 \"body\"\n$EndPhysicalNames\n" + nodes_22 +
                                "$Elements\n4\n1 2 2 7 1 1 2 4\n2 2 2 8 1 1 2 4\n3 2 2 0 1 1 2 30\n4 15 2 1 1 30\n"
                                "$EndElements\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[0].surface, 7);
  EXPECT_EQ(mesh.triangles[1].surface, 8);
  ASSERT_EQ(mesh.surfaces.size(), 1u);
  EXPECT_EQ(mesh.surfaces[0].name, "a b");
}

TEST(Gmsh22, UnknownNodeIsNamed) {
  expect_contains(refusal(format_22 + nodes_22 + "$Elements\n1\n9 4 2 3 1 1 2 3 4\n$EndElements\n"),
                  {"part.msh:13: element 9 has node 3, which is not in $Nodes"});
}

TEST(Gmsh22, DoubledNodeNumberIsNamed) {
  expect_contains(refusal(format_22 + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n"),
                  {"part.msh:7: node 1 is in the file twice"});
}

TEST(Gmsh22, MoreNodesThanTheFileHoldsAreRefusedBeforeAllocating) {
  expect_contains(refusal(format_22 + "$Nodes\n2000000000\n1 0 0 0\n$EndNodes\n"),
                  {"part.msh:", "2000000000 nodes are announced", "truncated"});
  expect_contains(refusal(format_22 + "$Nodes\n-4\n1 0 0 0\n$EndNodes\n"), {"-4 nodes are announced"});
}

TEST(Gmsh22, WordInPlaceOfANumberIsQuotedWithItsLine) {
  expect_contains(refusal(format_22 + "$Nodes\n2\n1 0 0 0\n2 1 zero 0\n$EndNodes\n"),
                  {"part.msh:7: a number is expected", "\"zero\""});
  expect_contains(refusal(format_22 + "$Nodes\n2\n1 0 0 0\n2 1 0 0 5\n$EndNodes\n"),
                  {"part.msh:7:", "too many or too few"});
}

TEST(Gmsh22, CountsThatDoNotMatchAreRefused) {
  expect_contains(refusal(format_22 + "$Nodes\n1\n1 0 0 0\n2 1 0 0\n$EndNodes\n"),
                  {"part.msh:7: $EndNodes is missing here"});
}

TEST(Gmsh22, OtherElementsAreRefusedByName) {
  const std::string before = format_22 + nodes_22 + "$Elements\n1\n9 ";
  expect_contains(refusal(before + "5 2 1 1 1 2 30 4 1 2 30 4\n"),
                  {"part.msh:13: element type 5 (hexahedron)", "Recombine"});
  expect_contains(refusal(before + "11 2 1 1 1 2 30 4\n"), {"type 11 (curved, of higher order", "ElementOrder = 1"});
  expect_contains(refusal(before + "4 -1 1 2 30 4\n"), {"negative number of tags"});
}

TEST(Gmsh, OtherVersionsAreRefused) {
  expect_contains(refusal("$MeshFormat\n4 0 8\n$EndMeshFormat\n"), {"part.msh:2: format version \"4\"", "4.1 or 2.2"});
  expect_contains(refusal("$MeshFormat\n2.2 0 4\n$EndMeshFormat\n"), {"data size 4"});
}

TEST(Gmsh, OppositeByteOrderIsRecognised) {
  expect_contains(refusal("$MeshFormat\n2.2 1 8\n" + binary(0x01000000) + "\n$EndMeshFormat\n"),
                  {"part.msh: byte", "big-endian"});
  expect_contains(refusal("$MeshFormat\n2.2 1 8\n" + binary(77) + "\n$EndMeshFormat\n"), {"mark of the byte order"});
}

TEST(Gmsh, SectionWithoutAnEndIsTruncated) {
  expect_contains(refusal(format_22 + "$Periodic\n1\n"), {"$Periodic has no $EndPeriodic", "truncated"});
}

TEST(Gmsh, FileBehindItsFormatIsChecked) {
  expect_contains(refusal(format_22 + "Nodes\n"), {"part.msh:4: a section", "\"Nodes\""});
  expect_contains(refusal(format_41 + "$PartitionedEntities\n2\n"), {"partitioned"});
}

TEST(Gmsh22, BinaryBlocksAreRead) {
  std::string bytes = "$MeshFormat\n2.2 1 8\n" + binary(1) + "\n$EndMeshFormat\n$Nodes\n4\n";
  const double X[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 4; ++i) bytes += binary(i + 1) + binary(X[i][0]) + binary(X[i][1]) + binary(X[i][2]);
  bytes += "\n$EndNodes\n$Elements\n2\n";
  for (const int v : {2, 1, 2, 50, 7, 1, 1, 2, 3}) bytes += binary(v);
  const std::string cut = bytes;
  for (const int v : {4, 1, 0, 51, 1, 2, 3, 4}) bytes += binary(v);
  const FileMesh mesh = read_gmsh("part.msh", bytes + "\n$EndElements\n");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0].surface, 7);
  ASSERT_EQ(mesh.tetrahedra.size(), 1u);
  EXPECT_EQ(mesh.tetrahedra[0].number, 51);
  expect_contains(refusal(cut), {"part.msh: byte", "truncated"});
  expect_contains(refusal(cut + binary(4) + binary(2000000000)), {"2000000000 elements are announced"});
}

const std::string entities_41 = "$Entities\n0 0 1 1\n5 0 0 0 1 1 1 2 7 8 0\n1 0 0 0 1 1 1 0 1 5\n$EndEntities\n";
const std::string nodes_41 =
    "$Nodes\n2 4 1 4\n2 5 1 3\n1\n2\n3\n0 0 0 .1 .2\n1 0 0 .1 .2\n0 1 0 .1 .2\n3 1 0 1\n4\n0 0 1\n$EndNodes\n";

TEST(Gmsh41, ParametricNodesAndSurfacesInTwoGroupsAreRead) {
  const FileMesh mesh =
      read_gmsh("part.msh", format_41 + entities_41 + nodes_41 +
                                "$Elements\n2 2 1 2\n2 5 2 1\n1 1 2 3\n3 1 4 1\n2 1 2 3 4\n$EndElements\n");
  ASSERT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.points[2], (Vec3{0, 1, 0}));
  EXPECT_EQ(mesh.points[3], (Vec3{0, 0, 1}));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[0].surface, 7);
  EXPECT_EQ(mesh.triangles[1].surface, 8);
  ASSERT_EQ(mesh.tetrahedra.size(), 1u);
  EXPECT_EQ(mesh.tetrahedra[0].place, 27);
}

TEST(Gmsh41, WithoutEntitiesNoSurfaceHasAName) {
  const FileMesh mesh = read_gmsh(
      "part.msh", format_41 + nodes_41 + "$Elements\n2 2 1 2\n2 5 2 1\n1 1 2 3\n3 1 4 1\n2 1 2 3 4\n$EndElements\n");
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(mesh.tetrahedra.size(), 1u);
}

TEST(Gmsh41, WrongCountsAndDimensionsAreRefused) {
  expect_contains(refusal(format_41 + "$Nodes\n1 4 1 4\n7 1 0 4\n"), {"part.msh:6:", "dimension 7"});
  expect_contains(refusal(format_41 + "$Nodes\n1 4 1 4\n3 1 0 99999999999\n"), {"99999999999 nodes are announced"});
  expect_contains(refusal(format_41 + "$Entities\n0 0 888888888 1\n"), {"888888888 entities are announced"});
  expect_contains(refusal(format_41 + nodes_41 + "$Elements\n1 1 1 1\n3 1 4 1\n2 1 2 3\n$EndElements\n"),
                  {"an integer is expected", "\"$EndElements\""});
}

}  // namespace
}  // namespace tessera::test
