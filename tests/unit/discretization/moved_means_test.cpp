#include "tessera/discretization/moved_means.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

/// An irregular body with free faces, and what moves the means of its cells.
struct Body {
  explicit Body(double jitter)
      : cells(voronoi_body(box({1, 1.2, 0.9}), {5, 5, 4}, jitter, 3, nothing)),
        d(discretize(Method::variational, cells, Integration::cell)) {}

  /// Normals of a cell's faces by sides.
  std::map<Index, Vec3> normals(Index a) const {
    std::map<Index, Vec3> all;
    for (const BoundaryFace& f : cells.cells.boundary)
      if (f.owner == a) all[f.side] = normalized(f.area);
    return all;
  }

  VoronoiBody cells;
  Discretization d;
};

/// F_a of the motion u(y) about the particle.
template <class Motion>
Mat3 gradient(const Discretization& d, Index a, const Motion& u) {
  Mat3 F;
  for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
    F += outer(u(d.branch(a, i)), d.bonds.B_ab[static_cast<std::size_t>(i)]);
  return (1.0 / d.volume[static_cast<std::size_t>(a)]) * F;
}

/// Where the stretch in direction e is that of quadratic motions e (e . y) (m . y), from the particle.
Vec3 place_of_stretch(const Discretization& d, Index a, const Vec3& e) {
  Vec3 place;
  for (const Vec3& m : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 across = m - dot(m, e) * e;
    const auto stretch = [&](const Vec3& n) {
      return dot(e, gradient(d, a, [&](const Vec3& y) { return (dot(e, y) * dot(n, y)) * e; }) * e);
    };
    place += (stretch(across) + 0.5 * dot(m, e) * stretch(e)) * m;
  }
  return place;
}

/// The mean of it over the directions in the planes of the faces; no number at corners.
Vec3 place_of_mean(const Body& body, Index a) {
  const std::map<Index, Vec3> normals = body.normals(a);
  const Vec3 N = normals.begin()->second;
  if (normals.size() == 2) return place_of_stretch(body.d, a, normalized(cross(N, normals.rbegin()->second)));
  const Vec3 s = std::abs(N.x) > 0.5 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, t = cross(N, s);
  constexpr int angles = 8;
  Vec3 sum;
  for (int k = 0; k < angles; ++k) {
    const double angle = std::numbers::pi * k / angles;
    sum += place_of_stretch(body.d, a, std::cos(angle) * s + std::sin(angle) * t);
  }
  return (1.0 / angles) * sum;
}

/// The way by which a row moves linear fields.
Vec3 way_of_row(const Discretization& d, Index row) {
  const std::vector<Vec3>& C = d.measure->centroid;
  const auto a = static_cast<std::size_t>(d.measure->moved.particles[static_cast<std::size_t>(row)]);
  Vec3 way;
  for (const MeanTerm& t : d.measure->moved.terms.row(row))
    way += t.weight * (C[static_cast<std::size_t>(t.particle)] - C[a]);
  return way;
}

TEST(MovedMeans, RegularCellsStay) { EXPECT_TRUE(Body(0.0).d.measure->moved.particles.empty()); }

/// Along its faces a cell's F moves from the place of its mean to the centroid, across them by the mean over the
/// neighbours on the same side.
TEST(MovedMeans, MoveLinearFieldsToCentroids) {
  const Body body(0.25);
  const Discretization& d = body.d;
  std::map<Index, Vec3> ways;
  for (Index a = 0; a < d.particles(); ++a)
    if (const std::size_t faces = body.normals(a).size(); faces == 1 || faces == 2)
      ways[a] =
          d.measure->centroid[static_cast<std::size_t>(a)] - d.X[static_cast<std::size_t>(a)] - place_of_mean(body, a);
  ASSERT_EQ(d.measure->moved.particles.size(), ways.size());
  for (Index row = 0; row < d.measure->moved.terms.rows(); ++row) {
    const Index a = d.measure->moved.particles[static_cast<std::size_t>(row)];
    Vec3 expected = ways[a];
    for (const auto& [side, N] : body.normals(a)) {
      double V = 0.0, sum = 0.0;
      for (const auto& [b, way] : ways)
        if ((b == a || d.bonds.find(a, b) >= 0) && body.normals(b).contains(side)) {
          V += d.volume[static_cast<std::size_t>(b)];
          sum += d.volume[static_cast<std::size_t>(b)] * dot(way, N);
        }
      expected += (sum / V - dot(ways[a], N)) * N;
    }
    EXPECT_LT(norm(way_of_row(d, row) - expected), 1e-12) << "particle " << a;
  }
}

/// What is prescribed at a cell's faces is not [V 6].
TEST(MovedMeans, CellsWithPrescribedFacesStay) {
  const Discretization d =
      discretize(Method::variational, box({1, 1, 1}), {4, 4, 4}, 0.25, 3, everything, Integration::cell);
  EXPECT_TRUE(d.measure->moved.particles.empty());
}

}  // namespace
}  // namespace tessera::test
