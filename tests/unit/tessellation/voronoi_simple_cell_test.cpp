#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tessera/tessellation/clip.hpp"
#include "tessera/tessellation/voronoi_simple_cell.hpp"

namespace tessera {
namespace {

constexpr double kMargin = 1e-8;

using Outcome = SimpleCell::Outcome;

/// Area vector of every face by tag, its loops put together; those of the box under kBox.
std::map<Index, Vec3> areas(const SimpleCell& cell) {
  std::map<Index, Vec3> areas;
  cell.for_faces([&](Index tag, std::span<const Index> loop) {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      areas[tag] += 0.5 * cross(cell.position(loop[i]) - cell.position(loop[0]),
                                cell.position(loop[i + 1]) - cell.position(loop[0]));
  });
  return areas;
}

double volume(const SimpleCell& cell) {
  double sum = 0.0;
  cell.for_faces([&](Index, std::span<const Index> loop) {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += dot(cell.position(loop[0]), cross(cell.position(loop[i]), cell.position(loop[i + 1]))) / 6.0;
  });
  return sum;
}

TEST(SimpleCell, CutsOffACorner) {
  SimpleCell cell;
  cell.start(1.0);
  EXPECT_NEAR(volume(cell), 8.0, 1e-15);
  EXPECT_EQ(cell.clip({0, 0, 2}, 4.0, kMargin, 5), Outcome::untouched);
  EXPECT_EQ(cell.clip({3, 3, 3}, 7.5, kMargin, 6), Outcome::cut);
  EXPECT_EQ(cell.vertices(), 10);
  EXPECT_NEAR(volume(cell), 8.0 - 0.125 / 6.0, 1e-14);
  EXPECT_NEAR(norm(areas(cell).at(6)), std::sqrt(3.0) / 8.0, 1e-15);
  EXPECT_EQ(cell.radius2(), 3.0);
}

TEST(SimpleCell, IsInDoubtWhereVerticesAreCloseToThePlane) {
  for (const auto& [normal, offset] : {std::pair{Vec3{1, 1, 1}, 3.0}, std::pair{Vec3{0, 0, 4}, 4.0 + 3.9e-8},
                                       std::pair{Vec3{0, 0, 4}, 4.0 - 3.9e-8}, std::pair{Vec3{0, 0, 1}, -2.0}}) {
    SimpleCell cell;
    cell.start(1.0);
    EXPECT_EQ(cell.clip(normal, offset, kMargin, 5), Outcome::in_doubt);
  }
}

/// A cut along a face, at an angle too small to say where it crosses the edges.
TEST(SimpleCell, IsInDoubtAtGrazingCuts) {
  SimpleCell cell;
  cell.start(1.0);
  EXPECT_EQ(cell.clip({3e-6, 5e-6, 1}, 1.0 + 1e-7, kMargin, 5), Outcome::in_doubt);
}

/// Cut by random planes, it has the faces that the general clipper finds.
TEST(SimpleCell, AgreesWithTheClipper) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> distance(0.4, 1.2);
  for (int repeat = 0; repeat < 200; ++repeat) {
    SimpleCell cell;
    cell.start(1.0);
    ConvexPolyhedron expected;
    for (int v = 0; v < 8; ++v)
      expected.vertices.push_back({v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0});
    for (const std::array<Index, 4>& face :
         {std::array<Index, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
      expected.corners.insert(expected.corners.end(), face.begin(), face.end());
      expected.close_face(SimpleCell::kBox);
    }
    Clipper clipper(1e-14);
    for (Index tag = 0; tag < 40; ++tag) {
      const Vec3 n = normalized({normal(random), normal(random), normal(random)});
      const double offset = distance(random);
      const bool was_cut = clipper.clip(expected, {n, offset}, tag) == Clipper::Outcome::cut;
      EXPECT_EQ(cell.clip(2.5 * n, 2.5 * offset, kMargin, tag), was_cut ? Outcome::cut : Outcome::untouched);
    }
    double farthest = 0.0;
    for (const Vec3& X : expected.vertices) farthest = std::max(farthest, norm2(X));
    EXPECT_NEAR(cell.radius2(), farthest, 1e-13);
    EXPECT_EQ(static_cast<std::size_t>(cell.vertices()), expected.vertices.size());
    const std::map<Index, Vec3> found = areas(cell);
    Vec3 sum;
    for (const auto& [tag, area] : found) sum += area;
    EXPECT_LT(norm(sum), 1e-14);
    for (Index f = 0; f < expected.faces(); ++f) {
      const Index tag = expected.tags[static_cast<std::size_t>(f)];
      if (tag == SimpleCell::kBox) continue;
      Vec3 area;
      const auto at = [&](std::size_t i) { return expected.vertices[static_cast<std::size_t>(expected.face(f)[i])]; };
      for (std::size_t i = 1; i + 1 < expected.face(f).size(); ++i)
        area += 0.5 * cross(at(i) - at(0), at(i + 1) - at(0));
      EXPECT_LT(norm(found.at(tag) - area), 1e-13);
    }
  }
}

/// More faces than it has room for.
TEST(SimpleCell, IsInDoubtWhenItIsFull) {
  SimpleCell cell;
  cell.start(2.0);
  Outcome outcome = Outcome::cut;
  for (Index i = 0; i < 2 * SimpleCell::kMostFaces && outcome != Outcome::in_doubt; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / (2.0 * SimpleCell::kMostFaces), r = std::sqrt(1.0 - z * z);
    outcome = cell.clip({r * std::cos(2.4 * i), r * std::sin(2.4 * i), z}, 1.0, kMargin, i);
  }
  EXPECT_EQ(outcome, Outcome::in_doubt);
}

}  // namespace
}  // namespace tessera
