#include "tessera/mechanics/following.hpp"

#include <gtest/gtest.h>

#include "support/small_bodies.hpp"

namespace tessera::test {
namespace {

/// A body all around under the pressure 3 + X (or another) that follows.
struct Inflated {
  BoundaryCondition condition;
  System system;
  Tractions tractions;

  Inflated(Method method, std::array<int, 3> counts, double jitter, const Formula& pressure, const Solid& solid)
      : system(system_of(discretize(method, solid, counts, jitter, 3, nothing), rubber())) {
    condition.kind = FollowingPressure{pressure};
    std::vector<LoadedSite> sites;
    for (std::size_t i = 0; i < system.d.sites.size(); ++i)
      sites.push_back({static_cast<Index>(i), identity(), &condition});
    tractions = Tractions(system.d, sites);
    tractions.evaluate(0.0);
  }
  Inflated(const Inflated&) = delete;
  Inflated& operator=(const Inflated&) = delete;

  /// Forces on the particles moved by `motion`, through a full evaluation.
  std::span<const NodalForce> loads(const std::function<Vec3(const Vec3&)>& motion) {
    State state = reference_state(system);
    move(state, system, motion);
    Forces forces(system);
    forces.evaluate(state, {{}, tractions.forces(), {}, &tractions}, 0.0);
    return tractions.forces();
  }
};

struct Resultant {
  Vec3 force, moment;
  double size = 0.0;
};

Resultant resultant(std::span<const NodalForce> loads, const System& s,
                    const std::function<Vec3(const Vec3&)>& motion) {
  Resultant r;
  for (const NodalForce& l : loads) {
    r.force += l.force;
    r.moment += cross(motion(s.d.X[static_cast<std::size_t>(l.particle)]), l.force);
    r.size += norm(l.force);
  }
  return r;
}

/// The volume inside the present triangles.
double volume(const System& s, const std::vector<Vec3>& x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.d.sites.size(); i += 3) {  // three sites a triangle
    const auto& c = s.d.sites[i].corners;
    const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(c[k])]; };
    sum += dot(at(0), cross(at(1), at(2))) / 6.0;
  }
  return sum;
}

/// Delaunay: the forces are p times the derivative of the enclosed volume, so a change of it takes the work p dV; they
/// have neither a resultant nor a moment.
TEST(FollowingPressureOnTriangles, IsTheGradientOfTheVolume) {
  Inflated body(Method::delaunay, {3, 4, 3}, 0.2, Formula(3.0), box({1, 1.3, 0.8}));
  const auto motion = wavy;
  const auto loads = body.loads(motion);
  std::vector<Vec3> x;
  for (const Vec3& X : body.system.d.X) x.push_back(motion(X));
  for (const NodalForce& l : loads)
    for (int i = 0; i < 3; ++i) {
      const double h = 1e-3;
      std::vector<Vec3> more = x, less = x;
      more[static_cast<std::size_t>(l.particle)][i] += h;
      less[static_cast<std::size_t>(l.particle)][i] -= h;
      const double derivative = (volume(body.system, more) - volume(body.system, less)) / (2.0 * h);
      EXPECT_NEAR(l.force[i], -3.0 * derivative, 1e-9);
    }
  const Resultant r = resultant(loads, body.system, motion);
  EXPECT_LT(norm(r.force), 1e-13 * r.size);
  EXPECT_LT(norm(r.moment), 1e-13 * r.size);
}

/// A linear motion, however large: the exact force of -p J F^-T N on every face, no resultant, no moment, work p dV.
TEST(FollowingPressure, IsExactUnderLinearMotion) {
  const Mat3 F{{1.3, 0.4, -0.2, 0.1, 0.8, 0.3, -0.3, 0.2, 1.6}};
  const auto motion = [&](const Vec3& X) { return F * X + Vec3{1, 2, 3}; };
  for (const Method method : {Method::delaunay, Method::consistent, Method::variational, Method::quasi_static}) {
    Inflated body(method, {3, 3, 3}, 0.25, Formula(3.0), box({1, 1, 1}));
    const auto loads = body.loads(motion);
    const Resultant r = resultant(loads, body.system, motion);
    EXPECT_LT(norm(r.force), 1e-12 * r.size) << name_of(method);
    if (method == Method::delaunay || method == Method::consistent) {
      EXPECT_LT(norm(r.moment), 1e-12 * 5.0 * r.size) << name_of(method);
      // Under a further change dF of the motion the work is -p dV = -p J F^-T : dF V, V = 1.
      const Mat3 dF{{0.2, 0.5, -0.1, 0.3, 0.4, 0.1, 0.6, -0.7, 0.9}};
      double work = 0.0;
      for (const NodalForce& l : loads)
        work += dot(l.force, dF * body.system.d.X[static_cast<std::size_t>(l.particle)]);
      EXPECT_NEAR(work, -3.0 * contract(cofactor(F), dF), 1e-12) << name_of(method);
    }
  }
}

/// Voronoi: the deformation gradient of the cell stands for that of its face, so under a motion that is not linear the
/// resultant around a closed body vanishes with the spacing only, if fast.
TEST(FollowingPressureOnCells, LosesItsResultantWithTheSpacing) {
  std::vector<double> error;
  for (const int n : {4, 8, 16}) {
    Inflated body(Method::consistent, {n, n, n}, 0.25, Formula(3.0), box({1, 1, 1}));
    const Resultant r = resultant(body.loads(wavy), body.system, wavy);
    error.push_back(norm(r.force) / r.size);
    EXPECT_LT(norm(r.moment), r.size * 1e-3 / n);
  }
  EXPECT_LT(error[0], 1e-3);  // 6.3e-4, 1.2e-4, 5.7e-5 of the sum of the loads
  EXPECT_GT(error[0] / error[2], 8.0);
}

/// A pressure that varies is taken at the faces' material points, and a second evaluation replaces the first.
TEST(FollowingPressure, VariesOverTheBodyAndStartsAfresh) {
  const Formula p("3+X", {"case.toml", 1, 1, "p"});
  for (const Method method : {Method::delaunay, Method::consistent}) {
    Inflated body(method, {3, 3, 3}, 0.2, p, box({1, 1, 1}));
    const auto stretched = [](const Vec3& X) { return Vec3{2 * X.x, X.y, X.z}; };
    body.loads(wavy);
    // - integral of p N: on the sides x only, -(4 - 3) of unit area.
    const Resultant r = resultant(body.loads(stretched), body.system, stretched);
    EXPECT_LT(norm(r.force - Vec3{-1, 0, 0}), 1e-12) << name_of(method);
  }
}

}  // namespace
}  // namespace tessera::test
