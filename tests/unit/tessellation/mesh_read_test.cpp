#include <gtest/gtest.h>

#include "mesh_helpers.hpp"

namespace tessera::test {
namespace {

class GmshFiles : public testing::TestWithParam<const char*> {};

// The bar 1 x 0.5 x 0.5 m as Gmsh 4.8 wrote it; "77" is a physical surface without a name.
TEST_P(GmshFiles, RealBarIsReadWithItsNamedSurfaces) {
  const TetrahedralMesh mesh = read_mesh(data_path(GetParam()));
  EXPECT_EQ(mesh.points.size(), 23u);
  EXPECT_EQ(mesh.tetrahedra.size(), 48u);
  EXPECT_EQ(mesh.boundary.size(), 40u);
  expect_sound(mesh);
  EXPECT_NEAR(volume_of(mesh), 0.25, 1e-15);
  ASSERT_EQ(mesh.side_names.size(), 3u);
  expect_near(area_of(mesh, "clamped"), {-0.25, 0, 0}, 1e-15);
  expect_near(area_of(mesh, "loaded end"), {0.25, 0, 0}, 1e-15);
  expect_near(area_of(mesh, "77"), {0, -0.5, 0}, 1e-15);
  EXPECT_EQ(mesh.tetrahedra, read_mesh(data_path("bar_41_ascii.msh")).tetrahedra);
}

INSTANTIATE_TEST_SUITE_P(Formats, GmshFiles,
                         testing::Values("bar_22_ascii.msh", "bar_22_binary.msh", "bar_41_ascii.msh",
                                         "bar_41_binary.msh"),
                         [](const auto& instance) {
                           return std::string(instance.param).substr(0, std::string(instance.param).find('.'));
                         });

class VtuFiles : public testing::TestWithParam<const char*> {};

// The same bar as two split cubes, as VTK 9.1 wrote it.
TEST_P(VtuFiles, RealBarIsRead) {
  const TetrahedralMesh mesh = read_mesh(data_path(GetParam()));
  EXPECT_EQ(mesh.points.size(), 12u);
  EXPECT_EQ(mesh.points[5], (Vec3{1, 0.5, 0}));
  EXPECT_EQ(mesh.tetrahedra.size(), 12u);
  EXPECT_EQ(mesh.boundary.size(), 20u);
  EXPECT_TRUE(mesh.side_names.empty());
  expect_sound(mesh);
  EXPECT_NEAR(volume_of(mesh), 0.25, 1e-15);
  EXPECT_EQ(mesh.tetrahedra, read_mesh(data_path("bar_ascii_32.vtu")).tetrahedra);
}

INSTANTIATE_TEST_SUITE_P(Formats, VtuFiles,
                         testing::Values("bar_ascii_32.vtu", "bar_binary_64.vtu", "bar_binary_zlib_32.vtu",
                                         "bar_appended_32.vtu", "bar_appended_zlib_64.vtu", "bar_appendedraw_64.vtu",
                                         "bar_appendedraw_zlib_32.vtu"),
                         [](const auto& instance) {
                           return std::string(instance.param).substr(0, std::string(instance.param).find('.'));
                         });

TEST(ReadMesh, FileThatIsNotThereIsNamed) {
  expect_contains(geometry_error([] { read_mesh("/nowhere/part.msh"); }),
                  {"/nowhere/part.msh: cannot be read", "no such file"});
}

TEST(ReadMesh, FolderIsRefused) {
  const TemporaryFile file("x", "");
  const std::string folder = std::filesystem::path(file.path()).parent_path().string() + "/part.vtu";
  std::filesystem::create_directory(folder);
  expect_contains(geometry_error([&] { read_mesh(folder); }), {"part.vtu: cannot be read"});
}

TEST(ReadMesh, EmptyFileIsRefused) {
  const TemporaryFile file("part.vtu", "");
  expect_contains(geometry_error([&] { read_mesh(file.path()); }), {"part.vtu: the file is empty"});
}

TEST(ReadMesh, OtherKindsOfFilesAreRefused) {
  const TemporaryFile file("part.stl", "solid");
  expect_contains(geometry_error([&] { read_mesh(file.path()); }), {"part.stl", ".msh", ".vtu"});
}

TEST(ReadMesh, SecondOrderElementsAreRefusedWithTheCure) {
  const std::string message = geometry_error([] { read_mesh(data_path("bar_second_order.msh")); });
  expect_contains(message, {"bar_second_order.msh:", "higher order", "Mesh.ElementOrder = 1"});
}

TEST(ReadMesh, CapitalLettersInTheExtensionDoNotMatter) {
  const TemporaryFile file("PART.MSH", "nonsense");
  expect_contains(geometry_error([&] { read_mesh(file.path()); }), {"PART.MSH:1: $MeshFormat is missing"});
}

}  // namespace
}  // namespace tessera::test
