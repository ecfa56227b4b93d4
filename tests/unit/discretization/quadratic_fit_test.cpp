#include "tessera/discretization/quadratic_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/small_bodies.hpp"
#include "tessera/discretization/voronoi_common.hpp"

namespace tessera::test {
namespace {

struct Fitted {
  VoronoiBody body;
  QuadraticFits fits;

  Index resolved() const { return static_cast<Index>(std::count(fits.resolved.begin(), fits.resolved.end(), 1)); }
};

Fitted fitted(const Solid& solid, std::array<int, 3> counts, double jitter) {
  Fitted f{voronoi_body(solid, counts, jitter, 3, nothing), {}};
  f.fits = quadratic_fits(f.body.X, f.body.cells.volume, faces_of_cells(f.body.cells));
  return f;
}

/// What the fit of a particle finds of a function.
template <class Function>
Symmetric3 derivatives(const Fitted& f, Index a, Function&& function) {
  const auto k = static_cast<std::size_t>(a);
  Symmetric3 H;
  for (const Index b : f.fits.stencil.row(a)) {
    const Vec3& X_b = f.body.X[static_cast<std::size_t>(b)];
    H += (function(X_b) - function(f.body.X[k])) * f.fits.fit[k].weights(X_b - f.body.X[k]);
  }
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

/// Inside, at sides, edges, re-entrant edges and corners, and through three layers of cells.
TEST(QuadraticFits, AreExactForQuadraticsAndSoundEverywhere) {
  for (const double jitter : {0.0, 0.2, 0.4})
    for (const auto& [solid, counts] : std::vector<std::pair<Solid, std::array<int, 3>>>{
             {box({1, 1, 1}), {5, 5, 5}}, {box({2, 1, 0.5}), {12, 6, 3}}, {l_block(), {6, 10, 3}}}) {
      const Fitted f = fitted(solid, counts, jitter);
      EXPECT_EQ(f.resolved(), static_cast<Index>(f.body.X.size())) << "jitter " << jitter;
      for (Index a = 0; a < static_cast<Index>(f.body.X.size()); ++a) {
        EXPECT_LT(difference(derivatives(f, a, quadratic), its_derivatives), 1e-11) << a;
        EXPECT_LE(f.fits.amplification[static_cast<std::size_t>(a)], 1.75) << a;
      }
    }
}

/// Two layers do not determine the second derivative across; their cells say so.
TEST(QuadraticFits, AreNotResolvedByTwoLayers) {
  for (const double jitter : {0.0, 0.1}) {
    const Fitted f = fitted(box({2, 1, 0.4}), {10, 5, 2}, jitter);
    EXPECT_EQ(f.resolved(), 0) << "jitter " << jitter;
    EXPECT_TRUE(f.fits.stencil.value.empty());
  }
}

/// Particles in one plane see the second derivatives in it, and none out of it.
TEST(QuadraticFits, StayInThePlaneOfASlab) {
  Fitted f{voronoi_body(box({1, 1, 1}), {6, 6, 1}, 0.0, 3, nothing), {}};
  for (std::size_t a = 0; a < f.body.X.size(); ++a) {
    f.body.X[a].x += 0.02 * std::sin(7.0 * static_cast<double>(a));
    f.body.X[a].y += 0.02 * std::cos(5.0 * static_cast<double>(a));
  }
  f.body.cells = voronoi_cells(f.body.X, box({1, 1, 1}));
  f.fits = quadratic_fits(f.body.X, f.body.cells.volume, faces_of_cells(f.body.cells));
  EXPECT_EQ(f.resolved(), 36);
  for (Index a = 0; a < 36; ++a)
    EXPECT_LT(difference(derivatives(f, a, quadratic), {0.3, -0.7, 0.0, 1.1, 0.0, 0.0}), 1e-11) << a;
}

/// The unit of length does not matter.
TEST(QuadraticFits, ScaleWithLength) {
  const Fitted f = fitted(box({1, 1, 1}), {4, 4, 4}, 0.2);
  std::vector<Vec3> X = f.body.X;
  std::vector<double> volume = f.body.cells.volume;
  for (Vec3& p : X) p *= 1e-6;
  for (double& V : volume) V *= 1e-18;
  const QuadraticFits tiny = quadratic_fits(X, volume, faces_of_cells(f.body.cells));
  EXPECT_EQ(tiny.stencil.value, f.fits.stencil.value);
  for (std::size_t a = 0; a < X.size(); ++a) EXPECT_NEAR(tiny.amplification[a], f.fits.amplification[a], 1e-9);
}

}  // namespace
}  // namespace tessera::test
