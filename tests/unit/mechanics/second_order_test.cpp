#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "support/second_order_reference.hpp"
#include "support/triangle_surfaces.hpp"
#include "tessera/discretization/identities.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera::test {
namespace {

struct Body {
  std::string name;
  VoronoiBody body;
  bool has_unresolved = false;
};

Mat3 mixed_on_l_block(const Vec3& C, const Vec3& N) {
  if (C.x < 1e-9) return outer(N, N);
  if (C.y < 1e-9) return identity() - outer(N, N);
  if (C.z < 1e-9) return identity();
  return {};
}

/// Two layers of cells, where quadratics are not resolved, over one half of a slab and four over the other.
VoronoiBody two_and_four_layers(int length, int width, const Constrain& constrain) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  VoronoiBody body;
  for (int i = 0; i < length; ++i)
    for (int j = 0; j < width; ++j) {
      const int layers = 2 * i < length ? 2 : 4;
      for (int k = 0; k < layers; ++k)
        body.X.push_back({i + 0.5 + 0.2 * uniform(random), j + 0.5 + 0.2 * uniform(random),
                          3.0 * (k + 0.5) / layers + 0.02 * uniform(random)});
    }
  body.cells = voronoi_cells(body.X, box({1.0 * length, 1.0 * width, 3.0}), Moments::second_of_faces);
  for (const BoundaryFace& f : body.cells.boundary) body.D.push_back(constrain(f.centroid, normalized(f.area)));
  return body;
}

/// There are resolved cells, and unresolved ones or not.
void expect_unresolved(const Discretization& d, bool some) {
  const std::vector<char>& resolved = d.second_order->derivatives.resolved;
  const auto unresolved = static_cast<Index>(std::count(resolved.begin(), resolved.end(), 0));
  EXPECT_EQ(unresolved > 0, some);
  EXPECT_LT(unresolved, d.particles());
}

std::vector<Body> bodies() {
  return {{"free box", voronoi_body(box({1, 1, 1}), {4, 4, 4}, 0.25, 9, nothing)},
          {"mixed box", voronoi_body(box({1, 1, 1}), {4, 5, 4}, 0.25, 9, mixed)},
          {"L-block", voronoi_body(l_block(), {8, 13, 4}, 0.2, 4, mixed_on_l_block)},
          {"two and four layers", two_and_four_layers(10, 4, mixed_on_l_block), true}};
}

Vec3 to_vec3(const SecondOrderReference::Vector& v, std::size_t a) {
  const auto k = static_cast<Eigen::Index>(3 * a);
  return {v(k), v(k + 1), v(k + 2)};
}

/// F, energies, forces and reactions against the same written as sparse matrices.
TEST(SecondOrderForces, AreThoseOfTheReference) {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  for (const Body& b : bodies()) {
    SCOPED_TRACE(b.name);
    const Discretization d = discretize(Method::consistent, b.body, Integration::second_order);
    expect_unresolved(d, b.has_unresolved);
    const SecondOrderReference reference(b.body, m, d.second_order->derivatives);
    const auto motion = [](const Vec3& X) { return wavy((1.0 / 6.0) * X) * 6.0; };
    const std::vector<Vec3> x = noisy(b.body.X, motion, 0.03 * std::cbrt(b.body.cells.volume[0]));
    std::vector<Vec3> walls;
    for (const BoundaryFace& f : b.body.cells.boundary) walls.push_back(motion(f.centroid));
    const auto expected = reference.evaluate(reference.flat(x), reference.flat(walls));

    const System s = system_of(d, m);
    State state = reference_state(s);
    for (std::size_t a = 0; a < x.size(); ++a) state.x[a] = to_kernel(x[a]);
    std::vector<Vec3> node_walls, wall_forces, forces_of_particles;
    for (const BoundaryNode& f : s.d.nodes) {
      node_walls.push_back(walls[static_cast<std::size_t>(f.site)]);
      wall_forces.push_back(-to_vec3(expected.gw, static_cast<std::size_t>(f.site)));
    }
    for (std::size_t a = 0; a < x.size(); ++a) forces_of_particles.push_back(-to_vec3(expected.gx, a));
    Forces forces(s);
    forces.evaluate(state, {node_walls, {}, {}}, 0.0);
    for (std::size_t a = 0; a < x.size(); ++a)
      EXPECT_LT(size_of(to_mat3(forces.deformation_gradient()[a]) - reference.gradient(expected.F, a)), 1e-12) << a;
    EXPECT_NEAR(forces.sums().internal, expected.internal, 1e-12 * expected.internal);
    EXPECT_NEAR(forces.sums().contact, expected.contact, 1e-12 * expected.contact);
    EXPECT_LT(relative_difference(forces_of_particles, to_vectors(forces.total())), 1e-11);
    if (node_walls.empty()) continue;
    EXPECT_LT(relative_difference(wall_forces, forces.reactions()), 1e-11);
  }
}

Vec3 quadratic(const Vec3& X) {
  return X + Vec3{0.1 * X.x * X.x - 0.2 * X.y * X.z + 0.05 * X.x * X.z, 0.15 * X.y * X.y + 0.1 * X.x * X.y,
                  -0.1 * X.z * X.z + 0.2 * X.x * X.y};
}

Mat3 its_gradient(const Vec3& X) {
  return {{1.0 + 0.2 * X.x + 0.05 * X.z, -0.2 * X.z, -0.2 * X.y + 0.05 * X.x, 0.1 * X.y, 1.0 + 0.3 * X.y + 0.1 * X.x,
           0.0, 0.2 * X.y, 0.2 * X.x, 1.0 - 0.2 * X.z}};
}

std::vector<char> exact_cells(const Discretization& d) {
  std::vector<char> exact = d.second_order->derivatives.resolved;
  for (Index a = 0; a < d.particles(); ++a)
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i)
      if (!d.second_order->derivatives
               .resolved[static_cast<std::size_t>(d.bonds.neighbour[static_cast<std::size_t>(i)])])
        exact[static_cast<std::size_t>(a)] = 0;
  return exact;
}

/// The largest error of F, relative to F - I, over cells that are resolved like all their neighbours. At walls the mean
/// motion of the face is prescribed.
double error_of_quadratic_motion(const Discretization& d, std::size_t least_checked) {
  const std::vector<char> exact = exact_cells(d);
  EXPECT_GE(static_cast<std::size_t>(std::count(exact.begin(), exact.end(), 1)), least_checked);
  const System s = system_of(d, rubber());
  State state = reference_state(s);
  move(state, s, quadratic);
  std::vector<Vec3> walls;
  for (const BoundaryNode& f : s.d.nodes) walls.push_back(f.spread.mean(f.wall, quadratic));
  Forces forces(s);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  double worst = 0.0;
  for (std::size_t a = 0; a < exact.size(); ++a) {
    const Mat3 F = its_gradient(s.d.measure->centroid[a]);
    if (exact[a])
      worst = std::max(worst, size_of(to_mat3(forces.deformation_gradient()[a]) - F) / size_of(F - identity()));
  }
  return worst;
}

/// Free, symmetric, antisymmetric, component-wise and wholly prescribed faces that meet at edges and corners, and the
/// faces of a non-convex solid.
TEST(QuadraticMotion, IsExactInsideAndAtFacesOfAllKinds) {
  for (const auto& [name, constrain] :
       std::vector<std::pair<std::string, Constrain>>{{"free", nothing}, {"mixed", mixed}, {"held", everything}}) {
    SCOPED_TRACE(name);
    const VoronoiBody body = voronoi_body(box({1, 1, 1}), {5, 5, 5}, 0.25, 9, constrain);
    EXPECT_LT(error_of_quadratic_motion(discretize(Method::consistent, body, Integration::second_order), 125), 1e-11);
  }
  const VoronoiBody body = voronoi_body(l_block(), {8, 13, 4}, 0.25, 4, mixed_on_l_block);
  EXPECT_LT(error_of_quadratic_motion(discretize(Method::consistent, body, Integration::second_order), body.X.size()),
            1e-11);
}

/// The first order is not exact there: the test can fail.
TEST(QuadraticMotion, IsNotExactWithLinearFaces) {
  const VoronoiBody body = voronoi_body(box({1, 1, 1}), {5, 5, 5}, 0.25, 9, nothing);
  Discretization d = discretize(Method::consistent, body, Integration::second_order);
  for (Symmetric3& M : d.second_order->M) M = {};
  EXPECT_GT(error_of_quadratic_motion(d, 125), 1e-3);
}

/// Curved sides: every cell at them has many small boundary faces.
TEST(QuadraticMotion, IsExactInBodiesFromSurfaces) {
  for (const auto& [name, surface, h] : std::vector<std::tuple<std::string, TriangleSurface, double>>{
           {"ball", ball_surface(1.0, 12, 24), 0.3}, {"torus", torus_surface(1.0, 0.5, 24, 10), 0.22}}) {
    SCOPED_TRACE(name);
    const SurfaceIndex index(surface);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-0.2, 0.2);
    const Bounds region = bounds(surface);
    std::vector<Vec3> X;
    for (double x = region.lower.x + 0.5 * h; x < region.upper.x; x += h)
      for (double y = region.lower.y + 0.5 * h; y < region.upper.y; y += h)
        for (double z = region.lower.z + 0.5 * h; z < region.upper.z; z += h) {
          const Vec3 p = Vec3{x, y, z} + h * Vec3{uniform(random), uniform(random), uniform(random)};
          if (index.location(p) == Location::inside && index.nearest(p).distance > 0.2 * h) X.push_back(p);
        }
    const SurfaceCells made = surface_cells(X, index, Moments::second_of_faces);
    const std::vector<Mat3> D(made.cells.boundary.size());
    const Discretization d = discretize_consistent(X, made.cells, D, FaceOrder::quadratic);
    EXPECT_LT(error_of_quadratic_motion(d, X.size() / 2), 1e-11);
    EXPECT_NO_THROW(require(identities_of_voronoi(d, made.cells, volume(surface))));
  }
}

/// Forces of many particles, some of them in unresolved cells: the same bits for any number of threads.
TEST(SecondOrderForces, HaveTheSameBitsForAnyNumberOfThreads) {
  const int before = parallel::threads();
  const Discretization d =
      discretize(Method::consistent, two_and_four_layers(40, 15, mixed_on_l_block), Integration::second_order);
  expect_unresolved(d, true);
  const System s = system_of(d, rubber(), 300);
  const auto motion = [](const Vec3& X) { return 20.0 * wavy(0.05 * X); };
  const std::vector<Vec3> walls = walls_of(s, motion);
  const auto evaluate = [&](int threads) {
    parallel::set_threads(threads);
    State state = reference_state(s);
    move(state, s, motion);
    Forces forces(s);
    forces.evaluate(state, {walls, {}, {}}, 0.0);
    return std::pair{to_vectors(forces.total()), forces.reactions()};
  };
  const auto one = evaluate(1);
  for (const int threads : {2, 3}) EXPECT_EQ(one, evaluate(threads));
  parallel::set_threads(before);
}

/// What a report says of internal forces: with contact switched off they are the forces.
TEST(SecondOrderForces, OfTheInternalEnergyAreReported) {
  Material m = rubber();
  m.contact = {0.0, 0.0};
  const System s = system_of(discretize(Method::consistent, voronoi_body(box({1, 1, 1}), {4, 5, 4}, 0.25, 9, mixed),
                                        Integration::second_order),
                             m);
  const std::vector<Vec3> walls = walls_of(s, wavy);
  State state = reference_state(s);
  move(state, s, wavy);
  Forces forces(s);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  EXPECT_LT(relative_difference(to_vectors(forces.total()), to_vectors(forces.internal(state).force)), 1e-12);
}

}  // namespace
}  // namespace tessera::test
