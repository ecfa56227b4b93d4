#include <gtest/gtest.h>

#include "support/small_bodies.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera::test {
namespace {

class Threads : public testing::TestWithParam<Method> {
 protected:
  ~Threads() override { parallel::set_threads(before_); }

 private:
  int before_ = parallel::threads();
};

bool same_faces(const Cells& one, const Cells& two) {
  const auto same_interior = [](const InteriorFace& f, const InteriorFace& g) {
    return f.a == g.a && f.b == g.b && f.area == g.area && f.centroid == g.centroid;
  };
  const auto same_boundary = [](const BoundaryFace& f, const BoundaryFace& g) {
    return f.owner == g.owner && f.side == g.side && f.area == g.area && f.centroid == g.centroid;
  };
  return std::equal(one.interior.begin(), one.interior.end(), two.interior.begin(), two.interior.end(),
                    same_interior) &&
         std::equal(one.boundary.begin(), one.boundary.end(), two.boundary.begin(), two.boundary.end(), same_boundary);
}

void expect_same(const Discretization& one, const Discretization& two) {
  EXPECT_EQ(one.X, two.X);
  EXPECT_EQ(one.volume, two.volume);
  EXPECT_EQ(one.bonds.offset, two.bonds.offset);
  EXPECT_EQ(one.bonds.neighbour, two.bonds.neighbour);
  EXPECT_EQ(one.bonds.B_ab, two.bonds.B_ab);
  EXPECT_EQ(one.bonds.area_over_length, two.bonds.area_over_length);
  EXPECT_EQ(one.B_aa, two.B_aa);
  EXPECT_EQ(one.closure.offset, two.closure.offset);
  EXPECT_EQ(shortest_bonds(one), shortest_bonds(two));
}

/// More than 10000 particles, held and loaded faces: points, cells and bonds have the same bits for one, two and three
/// threads.
TEST_P(Threads, SetUpHasTheSameBits) {
  const auto build = [](int threads) {
    parallel::set_threads(threads);
    return voronoi_body(box({1, 1, 1}), {22, 22, 22}, 0.3, 7, mixed);
  };
  const VoronoiBody one = build(1);
  const Discretization d = discretize(GetParam(), one);
  ASSERT_GT(d.particles(), 10000);
  for (const int threads : {2, 3}) {
    const VoronoiBody other = build(threads);
    EXPECT_EQ(one.X, other.X);
    EXPECT_EQ(hilbert_order(one.X), hilbert_order(other.X));
    EXPECT_EQ(one.cells.volume, other.cells.volume);
    EXPECT_EQ(one.cells.centroid, other.cells.centroid);
    EXPECT_TRUE(same_faces(one.cells, other.cells));
    expect_same(d, discretize(GetParam(), other));
  }
}

/// The same for quadratic faces.
TEST_F(Threads, QuadraticFacesHaveTheSameBits) {
  const VoronoiBody body = voronoi_body(box({1, 1, 1}), {14, 14, 14}, 0.3, 7, mixed);
  const auto build = [&](int threads) {
    parallel::set_threads(threads);
    return discretize(Method::consistent, body, Integration::second_order);
  };
  const Discretization one = build(1);
  for (const int threads : {2, 3}) {
    const Discretization other = build(threads);
    expect_same(one, other);
    const SecondDerivatives &mine = one.second_order->derivatives, &others = other.second_order->derivatives;
    EXPECT_EQ(mine.amplification, others.amplification);
    EXPECT_EQ(mine.weight, others.weight);
    EXPECT_EQ(mine.averaged, others.averaged);
    EXPECT_EQ(mine.far.offset, others.far.offset);
    EXPECT_EQ(mine.far.value, others.far.value);
    for (std::size_t a = 0; a < mine.fit.size(); ++a) {
      EXPECT_EQ(mine.fit[a].S, others.fit[a].S) << a;
      EXPECT_EQ(mine.fit[a].A, others.fit[a].A) << a;
    }
    EXPECT_EQ(one.second_order->M, other.second_order->M);
    EXPECT_EQ(one.second_order->face, other.second_order->face);
  }
}

/// The same for Delaunay.
TEST_F(Threads, DelaunaySetUpHasTheSameBits) {
  const auto build = [](int threads) {
    parallel::set_threads(threads);
    return discretize_delaunay(tetrahedra(box({1, 1, 1}), {22, 22, 22}, 0.2, 7), {});
  };
  const Discretization one = build(1);
  for (const int threads : {2, 3}) expect_same(one, build(threads));
}

INSTANTIATE_TEST_SUITE_P(Voronoi, Threads,
                         testing::Values(Method::consistent, Method::variational, Method::quasi_static),
                         [](const auto& param) { return name_of(param.param); });

}  // namespace
}  // namespace tessera::test
