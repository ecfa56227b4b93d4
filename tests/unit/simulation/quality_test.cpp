#include <algorithm>
#include <fstream>

#include "sample.hpp"

namespace tessera::test {
namespace {

/// Cells of a lattice are alike; those at corners have three faces on the boundary.
TEST(ModelQuality, OfALattice) {
  const Quality q = build_model(cube_case(Method::consistent, {4, 4, 4}, 0.0)).quality;
  EXPECT_NEAR(q.smallest_volume, 1.0 / 64, 1e-15);
  EXPECT_NEAR(q.largest_volume, 1.0 / 64, 1e-15);
  EXPECT_EQ(q.fewest_faces, 6);
  EXPECT_EQ(q.most_faces, 6);
  EXPECT_NEAR(q.shortest_bond, 0.25, 1e-15);
  EXPECT_NEAR(q.typical_bond, 0.25, 1e-15);
  EXPECT_GT(q.shortest_steps.front().share, 0.7);
  EXPECT_EQ(q.few, 0);
}

/// One particle beside another shortens the step of all: both are named, by body, number and place.
TEST(ModelQuality, NamesTheFewParticlesThatShortenTheStep) {
  const std::string path = testing::TempDir() + "tessera_close_pair.csv";
  {
    std::ofstream file(path);
    file << "x,y,z\n";
    for (int i = 0; i < 125; ++i)
      file << 0.1 + 0.2 * (i % 5) << ',' << 0.1 + 0.2 * (i / 5 % 5) << ',' << 0.1 + 0.2 * (i / 25) << '\n';
    file << "0.51,0.5,0.5\n";  // 0.01 m from particle 62, in the middle
  }
  Case c = cube_case(Method::consistent);
  c.bodies[0].particles.source = PointFileSpec{path};
  const Quality q = build_model(c).quality;
  EXPECT_EQ(q.few, 2);
  EXPECT_NEAR(q.shortest_bond, 0.01, 1e-12);
  ASSERT_GE(q.shortest_steps.size(), 2U);
  std::vector<std::int64_t> named;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(q.shortest_steps[i].at.body, "cube");
    EXPECT_LT(q.shortest_steps[i].share, 0.5);
    named.push_back(q.shortest_steps[i].at.particle);
  }
  std::sort(named.begin(), named.end());
  EXPECT_EQ(named, (std::vector<std::int64_t>{62, 125}));
  EXPECT_TRUE(contains(to_text(q), "warning: 2 particles shorten the time step"));
}

/// The numbers of a second body are its own.
TEST(ModelQuality, OfSeveralBodies) {
  for (const Method method : {Method::delaunay, Method::consistent}) {
    Case c = cube_case(method, {4, 4, 4}, 0.1);
    c.bodies.push_back(box_body(method, "fine", {2, 0, 0}, {2.1, 0.1, 0.1}, {3, 3, 3}, 0.1));
    const Quality q = build_model(c).quality;
    for (const Quality::Step& s : q.shortest_steps) {
      EXPECT_EQ(s.at.body, "fine");
      EXPECT_LT(s.at.particle, method == Method::delaunay ? 64 : 27);
      EXPECT_GE(s.at.X.x, 2.0);
    }
    EXPECT_GT(q.largest_volume / q.smallest_volume, 100.0);
  }
}

}  // namespace
}  // namespace tessera::test
