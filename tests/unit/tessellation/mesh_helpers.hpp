#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tessera/base/error.hpp"
#include "tessera/tessellation/mesh_faces.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera::test {

inline double volume_of(const TetrahedralMesh& mesh) {
  double sum = 0.0;
  for (const Tetrahedron& t : mesh.tetrahedra) sum += six_volume(t, mesh.points) / 6.0;
  return sum;
}

/// The area vectors of the boundary triangles on the sides with this name, summed; of all for an empty name.
inline Vec3 area_of(const TetrahedralMesh& mesh, const std::string& name) {
  Vec3 sum;
  for (const BoundaryTriangle& t : mesh.boundary) {
    bool counts = name.empty();
    if (t.side >= 0)
      for (const std::string& n : mesh.side_names[static_cast<std::size_t>(t.side)]) counts = counts || n == name;
    if (counts) sum += area_vector(t.vertices, mesh.points);
  }
  return sum;
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Positive, sorted, conforming: every face inside used twice from opposite sides, every other one in the boundary.
inline void expect_sound(const TetrahedralMesh& mesh) {
  EXPECT_TRUE(std::is_sorted(mesh.tetrahedra.begin(), mesh.tetrahedra.end()));
  for (const Tetrahedron& t : mesh.tetrahedra) {
    EXPECT_GT(six_volume(t, mesh.points), 0.0);
    EXPECT_EQ(canonical(t), t);
  }
  std::vector<Triangle> outer;
  const std::vector<TetrahedronFace> faces = sorted_faces(mesh.tetrahedra);
  for_each_face(faces, [&](std::span<const TetrahedronFace> uses) {
    if (uses.size() == 1) return outer.push_back(uses[0].vertices);
    ASSERT_EQ(uses.size(), 2u);
    EXPECT_NE(uses[0].vertices, uses[1].vertices);
  });
  std::sort(outer.begin(), outer.end());
  ASSERT_EQ(outer.size(), mesh.boundary.size());
  for (std::size_t i = 0; i < outer.size(); ++i) EXPECT_EQ(outer[i], mesh.boundary[i].vertices);
  const double size = std::cbrt(volume_of(mesh));
  expect_near(area_of(mesh, ""), {}, 1e-13 * size * size);
}

/// The message of the GeometryError that `action` throws.
template <class Action>
std::string geometry_error(Action action) {
  try {
    action();
  } catch (const GeometryError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "no GeometryError was thrown";
  return "";
}

inline void expect_contains(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in: " << text;
}

inline std::string data_path(const std::string& name) { return TESSERA_SOURCE_DIR "/tests/data/meshes/" + name; }

/// A file in a folder of the running test's own, removed with it.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string folder = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(folder.begin(), folder.end(), '/', '_');
    folder_ = std::filesystem::path(testing::TempDir()) / ("tessera_" + folder);
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / name).string();
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove_all(folder_); }
  const std::string& path() const { return path_; }

 private:
  std::filesystem::path folder_;
  std::string path_;
};

}  // namespace tessera::test
