#include "tessera/discretization/second_derivatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

Discretization curved(const Solid& solid, std::array<int, 3> counts, double jitter, const Constrain& constrain) {
  return discretize(Method::consistent, voronoi_body(solid, counts, jitter, 3, constrain), Integration::second_order);
}

Index resolved(const Discretization& d) {
  const std::vector<char>& all = d.second_order->derivatives.resolved;
  return static_cast<Index>(std::count(all.begin(), all.end(), 1));
}

/// The mean second derivatives of a function at a particle.
template <class Function>
Symmetric3 derivatives(const Discretization& d, Index a, Function&& function) {
  const double own = function(d.X[static_cast<std::size_t>(a)]);
  Symmetric3 H;
  for (const CurvatureTerm& t : mean_curvature(d, *d.second_order, d.measure->centroid, a))
    H += (function(d.X[static_cast<std::size_t>(t.particle)]) - own) * t.W;
  return H;
}

double difference(const Symmetric3& a, const Symmetric3& b) {
  const Symmetric3 d = a - b;
  return std::sqrt(contract(d, d));
}

double quadratic(const Vec3& X) {
  return 3.0 + X.x - 2.0 * X.y + 0.5 * X.z + 0.15 * X.x * X.x - 0.7 * X.x * X.y + 0.2 * X.x * X.z + 0.55 * X.y * X.y +
         0.5 * X.y * X.z - 0.2 * X.z * X.z;
}
constexpr Symmetric3 its_derivatives{0.3, -0.7, 0.2, 1.1, 0.5, -0.4};

/// Inside, at sides, edges, re-entrant edges and corners, through three layers of cells, at faces of all kinds.
TEST(SecondDerivatives, AreExactForQuadraticsEverywhere) {
  for (const Constrain& constrain : {Constrain(nothing), Constrain(mixed), Constrain(everything)})
    for (const double jitter : {0.0, 0.2, 0.4})
      for (const auto& [solid, counts] : std::vector<std::pair<Solid, std::array<int, 3>>>{
               {box({1, 1, 1}), {5, 5, 5}}, {box({2, 1, 0.5}), {12, 6, 3}}, {l_block(), {6, 10, 3}}}) {
        const Discretization d = curved(solid, counts, jitter, constrain);
        EXPECT_EQ(resolved(d), d.particles()) << "jitter " << jitter;
        for (Index a = 0; a < d.particles(); ++a)
          EXPECT_LT(difference(derivatives(d, a, quadratic), its_derivatives), 1e-11) << a;
      }
}

/// Two layers do not determine the second derivative across; their cells say so.
TEST(SecondDerivatives, AreNotResolvedByTwoLayers) {
  for (const double jitter : {0.0, 0.1}) {
    const Discretization d = curved(box({2, 1, 0.4}), {10, 5, 2}, jitter, nothing);
    EXPECT_EQ(resolved(d), 0) << "jitter " << jitter;
    EXPECT_TRUE(mean_curvature(d, *d.second_order, d.measure->centroid, 7).empty());
  }
}

/// Particles in one plane see the second derivatives in it, and none out of it, however thick the slab.
TEST(SecondDerivatives, StayInThePlaneOfASlab) {
  for (const double thickness : {0.1, 1.0, 100.0}) {
    const Solid solid = box({1, 1, thickness});
    VoronoiBody body = voronoi_body(solid, {6, 6, 1}, 0.0, 3, [thickness](const Vec3& C, const Vec3& N) {
      return std::abs(C.z / thickness - 0.5) > 0.49 ? outer(N, N) : Mat3{};
    });
    for (std::size_t a = 0; a < body.X.size(); ++a) {
      body.X[a].x += 0.02 * std::sin(7.0 * static_cast<double>(a));
      body.X[a].y += 0.02 * std::cos(5.0 * static_cast<double>(a));
    }
    body.cells = voronoi_cells(body.X, solid, Moments::second_of_faces);
    body.D.clear();
    for (const BoundaryFace& f : body.cells.boundary) {
      const Vec3 N = normalized(f.area);
      body.D.push_back(std::abs(N.z) > 0.5 ? outer(N, N) : Mat3{});
    }
    const Discretization d = discretize(Method::consistent, body, Integration::second_order);
    EXPECT_EQ(resolved(d), 36) << thickness;
    for (Index a = 0; a < 36; ++a)
      EXPECT_LT(difference(derivatives(d, a, quadratic), {0.3, -0.7, 0.0, 1.1, 0.0, 0.0}), 1e-11) << a;
  }
}

}  // namespace
}  // namespace tessera::test
