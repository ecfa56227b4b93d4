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

/// What terms at a particle make of a function.
template <class Function>
Symmetric3 derivatives(const Discretization& d, Index a, const std::vector<CurvatureTerm>& terms, Function&& function) {
  const double own = function(d.X[static_cast<std::size_t>(a)]);
  Symmetric3 H;
  for (const CurvatureTerm& t : terms) H += (function(d.X[static_cast<std::size_t>(t.particle)]) - own) * t.W;
  return H;
}

/// H_a, and the second derivatives that the cell uses.
std::vector<std::vector<CurvatureTerm>> both(const Discretization& d, Index a) {
  const SecondDerivatives& s = d.second_order->derivatives;
  return {curvature(d, s, a), cell_curvature(d, s, a)};
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

/// Inside, at sides, edges, re-entrant edges and corners, through four layers of cells, at faces of all kinds.
TEST(SecondDerivatives, AreExactForQuadraticsEverywhere) {
  for (const Constrain& constrain : {Constrain(nothing), Constrain(mixed), Constrain(everything)})
    for (const double jitter : {0.0, 0.2, 0.4})
      for (const auto& [solid, counts] : std::vector<std::pair<Solid, std::array<int, 3>>>{
               {box({1, 1, 1}), {5, 5, 5}}, {box({2, 1, 0.5}), {16, 8, 4}}, {l_block(), {8, 13, 4}}}) {
        const Discretization d = curved(solid, counts, jitter, constrain);
        EXPECT_EQ(resolved(d), d.particles()) << "jitter " << jitter;
        for (Index a = 0; a < d.particles(); ++a)
          for (const std::vector<CurvatureTerm>& terms : both(d, a))
            EXPECT_LT(difference(derivatives(d, a, terms, quadratic), its_derivatives), 1e-11) << a;
      }
}

/// Two layers do not determine the second derivative across, three do not leave the step as long as it was; their cells
/// say so, in slabs and bars.
TEST(SecondDerivatives, AreNotResolvedByTwoOrThreeLayers) {
  for (const double jitter : {0.0, 0.1, 0.2, 0.3})
    for (const std::array<int, 3>& counts : {std::array{10, 5, 2}, {10, 10, 3}, {9, 3, 4}, {9, 3, 3}, {3, 3, 3}}) {
      const Solid solid = box({0.1 * counts[0], 0.1 * counts[1], 0.1 * counts[2]});
      const Discretization d = curved(solid, counts, jitter, nothing);
      EXPECT_EQ(resolved(d), 0) << "jitter " << jitter << ", " << counts[1] << " x " << counts[2];
      for (const std::vector<CurvatureTerm>& terms : both(d, 7)) EXPECT_TRUE(terms.empty());
    }
}

/// Four are enough, also of cells that are flat, if these are not very irregular.
TEST(SecondDerivatives, AreResolvedByFourLayers) {
  for (const auto& [jitter, flat] : {std::pair{0.0, 1.0}, {0.1, 1.0}, {0.2, 1.0}, {0.3, 1.0}, {0.0, 0.5}, {0.1, 0.5}})
    for (const std::array<int, 3>& counts : {std::array{10, 10, 4}, {9, 4, 4}, {4, 4, 4}, {6, 5, 4}}) {
      const Solid solid = box({0.1 * counts[0], 0.1 * counts[1], 0.1 * flat * counts[2]});
      EXPECT_EQ(resolved(curved(solid, counts, jitter, nothing)), counts[0] * counts[1] * counts[2])
          << "jitter " << jitter << ", " << counts[1] << " x " << counts[2] << ", " << flat;
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
      for (const std::vector<CurvatureTerm>& terms : both(d, a))
        EXPECT_LT(difference(derivatives(d, a, terms, quadratic), {0.3, -0.7, 0.0, 1.1, 0.0, 0.0}), 1e-11) << a;
  }
}

std::vector<char> at_boundary(const VoronoiBody& body) {
  std::vector<char> all(body.X.size());
  for (const BoundaryFace& f : body.cells.boundary) all[static_cast<std::size_t>(f.owner)] = 1;
  return all;
}

bool same(const std::vector<CurvatureTerm>& one, std::vector<CurvatureTerm> other) {
  std::sort(other.begin(), other.end(),
            [](const CurvatureTerm& l, const CurvatureTerm& r) { return l.particle < r.particle; });
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](const auto& l, const auto& r) {
    return l.particle == r.particle && difference(l.W, r.W) <= 1e-13 * (1.0 + difference(l.W, {}));
  });
}

/// Cells at the boundary use the mean of their own and their neighbours', those inside what is their own.
TEST(SecondDerivatives, AreMeansAtTheBoundaryOnly) {
  for (const double jitter : {0.0, 0.3})
    for (const Constrain& constrain : {Constrain(nothing), Constrain(mixed)}) {
      const VoronoiBody body = voronoi_body(box({1, 1, 1}), {5, 5, 5}, jitter, 3, constrain);
      const Discretization d = discretize(Method::consistent, body, Integration::second_order);
      EXPECT_EQ(d.second_order->derivatives.averaged, at_boundary(body)) << "jitter " << jitter;
      for (Index a = 0; a < d.particles(); ++a) {
        const bool is_averaged = d.second_order->derivatives.averaged[static_cast<std::size_t>(a)] != 0;
        EXPECT_NE(same(both(d, a)[1], both(d, a)[0]), is_averaged) << a;
      }
    }
}

/// Maps of a box with equal edges, about its middle, onto itself.
std::vector<Mat3> symmetries() {
  std::vector<Mat3> all;
  for (std::array<std::size_t, 3> order{0, 1, 2}; all.size() < 48;) {
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 g;
      for (std::size_t i = 0; i < 3; ++i) g.m[3 * i + order[i]] = (signs >> i & 1) != 0 ? -1.0 : 1.0;
      all.push_back(g);
    }
    std::next_permutation(order.begin(), order.end());
  }
  return all;
}

Index nearest(const std::vector<Vec3>& X, const Vec3& place) {
  const auto closer = [&](const Vec3& l, const Vec3& r) { return norm2(l - place) < norm2(r - place); };
  return static_cast<Index>(std::min_element(X.begin(), X.end(), closer) - X.begin());
}

/// How far terms at `image` are from those at a, taken by g to the places there, relative to these.
double asymmetry(const Discretization& d, const Mat3& g, const std::vector<CurvatureTerm>& terms, Index a,
                 const std::vector<CurvatureTerm>& expected, Index image) {
  const auto at = [&](Index b) { return d.X[static_cast<std::size_t>(b)]; };
  if (terms.size() != expected.size()) return 1.0;
  double worst = 0.0, size = 0.0;
  for (const CurvatureTerm& t : terms) {
    const Index b = nearest(d.X, at(image) + g * (at(t.particle) - at(a)));
    const auto found = std::find_if(expected.begin(), expected.end(), [&](const auto& e) { return e.particle == b; });
    if (found == expected.end()) return 1.0;
    const Mat3 off = g * to_mat3(t.W) * transpose(g) - to_mat3(found->W);
    worst = std::max(worst, std::sqrt(contract(off, off)));
    size = std::max(size, difference(t.W, {}));
  }
  return worst / size;
}

VoronoiBody regular(LatticeKind kind, std::array<int, 3> counts, const Vec3& size) {
  LatticeSpec spec;
  spec.counts = counts;
  spec.kind = kind;
  VoronoiBody body;
  body.X = place_particles({spec, {}}, box(size), Placement::cell_centres).points;
  body.cells = voronoi_cells(body.X, box(size), Moments::second_of_faces);
  body.D.assign(body.cells.boundary.size(), {});
  return body;
}

/// Inside a lattice of cubes all cells are alike, and no direction comes before another: particles equally far are
/// taken together.
TEST(SecondDerivatives, InsideLatticesHaveTheirSymmetry) {
  for (const LatticeKind kind : {LatticeKind::cubic, LatticeKind::bcc, LatticeKind::fcc}) {
    const VoronoiBody body = regular(kind, {7, 6, 6}, {0.7, 0.6, 0.6});
    const Discretization d = discretize(Method::consistent, body, Integration::second_order);
    std::vector<Index> inside;  // whose neighbours are not at the boundary
    for (Index a = 0; a < d.particles(); ++a) {
      const Vec3 X = d.X[static_cast<std::size_t>(a)];
      if (std::min({X.x, X.y, X.z, 0.7 - X.x, 0.6 - X.y, 0.6 - X.z}) > 0.21) inside.push_back(a);
    }
    ASSERT_GE(inside.size(), 12U);
    const std::vector<CurvatureTerm> first = both(d, inside[0])[0];
    for (const Index a : inside) {
      EXPECT_FALSE(d.second_order->derivatives.averaged[static_cast<std::size_t>(a)]) << a;
      const std::vector<CurvatureTerm> terms = both(d, a)[0];
      for (const Mat3& g : symmetries()) EXPECT_LT(asymmetry(d, g, first, inside[0], terms, a), 1e-9) << a;
    }
  }
}

/// A cube of a lattice of cubes, whose symmetries are the body's: cells at sides, edges and corners have them too.
TEST(SecondDerivatives, OfARegularBodyHaveItsSymmetry) {
  const VoronoiBody body = regular(LatticeKind::cubic, {5, 5, 5}, {1, 1, 1});
  const Discretization d = discretize(Method::consistent, body, Integration::second_order);
  const Vec3 middle{0.5, 0.5, 0.5};
  std::vector<std::vector<std::vector<CurvatureTerm>>> terms;
  for (Index a = 0; a < d.particles(); ++a) terms.push_back(both(d, a));
  for (const Mat3& g : symmetries())
    for (Index a = 0; a < d.particles(); ++a) {
      const auto own = static_cast<std::size_t>(a);
      const Index image = nearest(d.X, middle + g * (d.X[own] - middle));
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_LT(asymmetry(d, g, terms[own][k], a, terms[static_cast<std::size_t>(image)][k], image), 1e-9) << a;
    }
}

}  // namespace
}  // namespace tessera::test
