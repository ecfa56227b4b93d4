#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "shapes.hpp"
#include "tessera/geometry/particles.hpp"

namespace tessera {
namespace {

using namespace test;

class PointFile : public ::testing::Test {
 protected:
  PointSet read(const std::string& text, Placement placement = Placement::cell_centres) {
    std::ofstream(path_, std::ios::binary) << text;
    return place_particles({PointFileSpec{path_}, somewhere()}, solid_, placement);
  }
  template <class ExpectedError>
  std::string error(const std::string& text, Placement placement = Placement::cell_centres) {
    return message_of<ExpectedError>([&] { read(text, placement); });
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::string path_ =
      ::testing::TempDir() + "tessera_" + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
  Solid solid_ = build_solid(box({0, 0, 0}, {1, 1, 1}));
};

TEST_F(PointFile, ReadsAnyColumnOrder) {
  const PointSet set = read("z, x,y\n\n0.1,0.2, 3e-1\n 0.4 ,+0.5,0.6\n");
  ASSERT_EQ(set.points.size(), 2U);
  EXPECT_EQ(set.points[0], (Vec3{0.2, 0.3, 0.1}));
  EXPECT_EQ(set.points[1], (Vec3{0.5, 0.6, 0.4}));
  EXPECT_FALSE(set.lattice);
}

TEST_F(PointFile, ReadsRadii) {
  const PointSet set = read("x,radius,y,z\n0.1,0.05,0.2,0.3\n0.4,0,0.5,0.6\n");
  EXPECT_EQ(set.points[1], (Vec3{0.4, 0.5, 0.6}));
  EXPECT_EQ(set.radius, (std::vector<double>{0.05, 0.0}));
  EXPECT_TRUE(read("x,y,z\n0.1,0.2,0.3\n").radius.empty());
}

TEST_F(PointFile, ReadsWindowsFiles) {
  const PointSet set = read("\xef\xbb\xbfx,y,z\r\n0.1,0.2,0.3\r\n\r\n0.4,0.5,0.6");
  ASSERT_EQ(set.points.size(), 2U);
  EXPECT_EQ(set.points[1], (Vec3{0.4, 0.5, 0.6}));
}

TEST_F(PointFile, MalformedFilesNameLineAndColumn) {
  expect_contains(error<InputError>("x,y,z\n0.1,0.2,0.3\n0.1, abc,0.3\n"),
                  path_ + ":3:6: 'abc' is not a finite number");
  expect_contains(error<InputError>("x,y,z\n0.1,,0.3\n"), path_ + ":2:5: '' is not a finite number");
  expect_contains(error<InputError>("x,y,z\n0.1,nan,0.3\n"), ":2:5: 'nan'");
  expect_contains(error<InputError>("x,y,z\n0.1,0.2m,0.3\n"), ":2:5: '0.2m'");
  expect_contains(error<InputError>("x,y,z\n0.1,0.2\n"), ":2:1: found 2 fields, expected 3");
  expect_contains(error<InputError>("0.1,0.2,0.3\n"), ":1:1: unknown column '0.1'");
  expect_contains(error<InputError>("x,y,z,mass\n"), ":1:7: unknown column 'mass'");
  expect_contains(error<InputError>("x,y,z,radius\n0.1,0.2,0.3,-1\n"), ":2:13: the radius -1 is negative");
  expect_contains(error<InputError>("x,y,radius\n"), ":1:1: the header must name the three columns");
  expect_contains(error<InputError>("x,y,x\n"), ":1:5: column 'x' appears twice");
  expect_contains(error<InputError>("x,y\n"), ":1:1: the header must name the three columns");
  expect_contains(error<InputError>(""), "the file is empty");
  expect_contains(error<InputError>("x,y,z\n"), "holds no points");
}

TEST_F(PointFile, UnreadableFile) {
  const std::string message = message_of<InputError>([&] {
    place_particles({PointFileSpec{"/no/such/points.csv"}, somewhere()}, solid_, Placement::cell_centres);
  });
  expect_contains(message, "case.toml:7:3: shape: cannot read the point file '/no/such/points.csv'");
}

TEST_F(PointFile, PointsOutside) {
  expect_contains(error<GeometryError>("x,y,z\n.5,.5,.5\n\n.5,1.2,.5\n"),
                  ":4: particle 1 at (0.5, 1.2, 0.5) m lies outside the solid");
  expect_contains(error<GeometryError>("x,y,z\n1,.5,.5\n"), ":2: particle 0 at (1, 0.5, 0.5) m lies on the boundary");
  EXPECT_EQ(read("x,y,z\n1,.5,.5\n", Placement::vertices).points.size(), 1U);
}

TEST_F(PointFile, DoubledPointsAreNamedBoth) {
  const std::string message = error<GeometryError>("x,y,z\n.1,.5,.5\n.5,.5,.5\n.9,.5,.5\n.5,.5,.50000001\n");
  expect_contains(message, "particles 1 at (0.5, 0.5, 0.5) m (line 3) and 3 at (0.5, 0.5, 0.5) m (line 5)");
  expect_contains(message, "closer to each other than 1e-06 of the mean spacing");
  EXPECT_EQ(read("x,y,z\n.1,.5,.5\n.5,.5,.5\n.9,.5,.5\n.5,.5,.500001\n").points.size(), 4U);
}

}  // namespace
}  // namespace tessera
