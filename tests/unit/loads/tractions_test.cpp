#include "sample.hpp"

namespace tessera::test {
namespace {

std::vector<LoadedSite> all_sites(const Discretization& d, const BoundaryCondition& c, const Mat3& free = identity()) {
  std::vector<LoadedSite> sites;
  for (std::size_t i = 0; i < d.sites.size(); ++i) sites.push_back({static_cast<Index>(i), free, &c});
  return sites;
}

struct Resultant {
  Vec3 force, moment;
};

Resultant resultant(const Discretization& d, const Tractions& tractions) {
  Resultant r;
  for (const NodalForce& l : tractions.forces()) {
    r.force += l.force;
    r.moment += cross(d.X[static_cast<std::size_t>(l.particle)], l.force);
  }
  return r;
}

/// The integral of polynomials over triangles by a rule of degree five (seven points).
template <class Density>
Vec3 integral(const TetrahedralMesh& mesh, const Density& density) {
  const double r = std::sqrt(15.0), w0 = 0.225, w1 = (155 - r) / 1200, w2 = (155 + r) / 1200;
  const double b1 = (6 - r) / 21, b2 = (6 + r) / 21;
  const std::vector<std::pair<double, std::array<double, 3>>> points{
      {w0, {1.0 / 3, 1.0 / 3, 1.0 / 3}}, {w1, {1 - 2 * b1, b1, b1}}, {w1, {b1, 1 - 2 * b1, b1}},
      {w1, {b1, b1, 1 - 2 * b1}},        {w2, {1 - 2 * b2, b2, b2}}, {w2, {b2, 1 - 2 * b2, b2}},
      {w2, {b2, b2, 1 - 2 * b2}}};
  Vec3 sum;
  for (const BoundaryTriangle& t : mesh.boundary) {
    std::array<Vec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = mesh.points[static_cast<std::size_t>(t.vertices[i])];
    const Vec3 area = 0.5 * cross(x[1] - x[0], x[2] - x[0]);
    for (const auto& [w, b] : points) {
      const Vec3 X = b[0] * x[0] + b[1] * x[1] + b[2] * x[2];
      sum += (w * norm(area)) * density(X, normalized(area));
    }
  }
  return sum;
}

/// Tractions and pressures that are linear over each triangle: exact force and moment.
TEST(TractionsOnTriangles, GiveExactResultants) {
  const TetrahedralMesh mesh = tetrahedra(box({1, 2, 1.5}), {3, 4, 3}, 0.2, 7);
  const Discretization d = discretize_delaunay(mesh, {});
  const BoundaryCondition linear =
      entry(1, {}, NominalTraction{{*formula("1+2*X-Y"), *formula("t*(3*Z-X)"), *formula("4+Y*t")}});
  const BoundaryCondition pressure = entry(1, {}, NominalPressure{*formula("t*(2+X-3*Y+0.5*Z)")});
  const double t = 0.7;
  const auto traction_at = [&](const Vec3& X, const Vec3&) {
    return Vec3{1 + 2 * X.x - X.y, t * (3 * X.z - X.x), 4 + X.y * t};
  };
  const auto pressure_at = [&](const Vec3& X, const Vec3& N) { return -t * (2 + X.x - 3 * X.y + 0.5 * X.z) * N; };
  const auto expect_exact = [&](const BoundaryCondition& c, const auto& density) {
    Tractions tractions(d, all_sites(d, c));
    tractions.evaluate(t);
    const Resultant r = resultant(d, tractions);
    const Vec3 force = integral(mesh, density);
    const Vec3 moment = integral(mesh, [&](const Vec3& X, const Vec3& N) { return cross(X, density(X, N)); });
    EXPECT_LT(norm(r.force - force), 1e-13 * 50);
    EXPECT_LT(norm(r.moment - moment), 1e-13 * 50);
  };
  expect_exact(linear, traction_at);
  expect_exact(pressure, pressure_at);
}

/// Voronoi faces: the force is the sum of A T(C); its moment about the origin is that of the faces' centroids for the
/// consistent formulation, whose shares reproduce them.
TEST(TractionsOnFaces, GiveExactResultants) {
  const VoronoiBody body = voronoi_body(box({1, 1, 1}), {3, 3, 3}, 0.3, 5, nothing);
  const BoundaryCondition c = entry(1, {}, NominalTraction{{*formula("1+2*X-Y"), *formula("3*Z"), *formula("4")}});
  Vec3 force, moment;
  for (const BoundaryFace& f : body.cells.boundary) {
    const Vec3 T{1 + 2 * f.centroid.x - f.centroid.y, 3 * f.centroid.z, 4};
    force += norm(f.area) * T;
    moment += cross(f.centroid, norm(f.area) * T);
  }
  for (Method method : {Method::consistent, Method::variational, Method::quasi_static}) {
    const Discretization d = discretize(method, body);
    Tractions tractions(d, all_sites(d, c));
    tractions.evaluate(0.0);
    EXPECT_LT(norm(resultant(d, tractions).force - force), 1e-13 * norm(force));
    if (method == Method::consistent) {
      EXPECT_LT(norm(resultant(d, tractions).moment - moment), 1e-13 * norm(moment));
    }
  }
}

/// A constant pressure all around a body has no resultant; on one side it is area times pressure along - N.
TEST(TractionsOnFaces, PressurePointsAgainstTheNormal) {
  const Solid solid = box({1, 2, 1});
  const VoronoiBody body = voronoi_body(solid, {3, 3, 3}, 0.3, 5, nothing);
  const Discretization d = discretize(Method::consistent, body);
  const BoundaryCondition c = entry(1, {}, NominalPressure{*formula("5*t")});
  Tractions around(d, all_sites(d, c));
  around.evaluate(1.0);
  EXPECT_LT(norm(resultant(d, around).force), 1e-13);
  std::vector<LoadedSite> sites;
  for (const LoadedSite& l : all_sites(d, c))
    if (d.sites[static_cast<std::size_t>(l.site)].N.x > 0.5) sites.push_back(l);
  Tractions one_side(d, sites);
  one_side.evaluate(2.0);
  EXPECT_LT(norm(resultant(d, one_side).force - Vec3{-20, 0, 0}), 1e-13);
}

/// What a constraint holds takes no load, several entries add up, and evaluating again starts from zero.
TEST(TractionsOnFaces, AddUpOverEntriesAndLeaveHeldComponentsOut) {
  const VoronoiBody body = voronoi_body(box({1, 1, 1}), {2, 2, 2}, 0.1, 5, nothing);
  const Discretization d = discretize(Method::consistent, body);
  const BoundaryCondition one = entry(1, {}, NominalTraction{{Formula(1.0), Formula(2.0), *formula("3*t")}});
  const BoundaryCondition two = entry(2, {}, NominalTraction{{Formula(10.0), Formula(20.0), Formula(30.0)}});
  std::vector<LoadedSite> sites = all_sites(d, one, diagonal(1, 0, 1));
  for (const LoadedSite& l : all_sites(d, two)) sites.push_back(l);
  Tractions tractions(d, sites);
  for (double t : {5.0, 1.0}) {
    tractions.evaluate(t);
    EXPECT_LT(norm(resultant(d, tractions).force - 6.0 * Vec3{11, 20, 30 + 3 * t}), 1e-12);
  }
  for (std::size_t i = 1; i < tractions.forces().size(); ++i)
    EXPECT_LT(tractions.forces()[i - 1].particle, tractions.forces()[i].particle);
}

}  // namespace
}  // namespace tessera::test
