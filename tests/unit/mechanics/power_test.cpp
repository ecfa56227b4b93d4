#include <gtest/gtest.h>

#include <array>

#include "support/balance.hpp"
#include "support/consistent_reference.hpp"
#include "support/radii.hpp"
#include "support/triangle_surfaces.hpp"
#include "tessera/discretization/identities.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera::test {
namespace {

constexpr std::array integrations{Integration::nodal, Integration::cell, Integration::second_order};

struct Body {
  std::string name;
  VoronoiBody body;
  double volume = 0.0;

  double most_unequal() const {
    double most = 0.0;
    for (const InteriorFace& f : body.cells.interior) most = std::max(most, std::abs(f.cut - 0.5));
    return most;
  }
};

void constrain(Body& b, const Constrain& projection) {
  b.body.D.clear();
  for (const BoundaryFace& f : b.body.cells.boundary) b.body.D.push_back(projection(f.centroid, normalized(f.area)));
}

Body in_solid(const std::string& name, const Solid& solid, std::array<int, 3> counts, unsigned seed) {
  Body b{name, {}, solid.volume};
  b.body.X = lattice(solid, counts, 0.2, seed, Placement::cell_centres).points;
  const double spacing = (solid.upper.x - solid.lower.x) / counts[0];
  const std::vector<double> weights = weights_up_to(0.55 * spacing, b.body.X.size(), seed);
  b.body.cells = voronoi_cells({b.body.X, weights}, solid, Moments::second_of_faces);
  return b;
}

Body in_surface(const std::string& name, const TriangleSurface& surface, double spacing, unsigned seed) {
  const SurfaceIndex index(surface);
  Body b{name, {}, volume(surface)};
  LatticeSpec spec;
  spec.spacing = spacing;
  spec.jitter = 0.2;
  spec.seed = seed;
  b.body.X = place_particles({spec, {}}, index).points;
  const std::vector<double> weights = weights_up_to(0.5 * spacing, b.body.X.size(), seed);
  b.body.cells = surface_cells({b.body.X, weights}, index, Moments::second_of_faces).cells;
  return b;
}

std::vector<Body> bodies() {
  return {in_solid("box", box({1, 1, 1}), {4, 4, 4}, 3), in_solid("L-block", l_block(), {8, 13, 4}, 4),
          in_surface("ball", ball_surface(1.0, 12, 24), 0.35, 1),
          in_surface("gear", turned(gear_surface(9, 0.4, 1.0, 1.3, 0.5), 0.7), 0.2, 2)};
}

System system_with(Body& b, const Constrain& projection, const Material& m, Integration integration) {
  constrain(b, projection);
  return system_of(discretize(Method::consistent, b.body, integration), m);
}

/// Regular tetrahedra, the dual of power cells, with the particles at the corners of a jittered lattice.
TetrahedralMesh regular_tetrahedra(const Solid& solid, unsigned seed) {
  PointSet set = lattice(solid, {5, 5, 5}, 0.2, seed, Placement::vertices);
  for (const double w : weights_up_to(0.1, set.points.size(), seed)) set.radius.push_back(std::sqrt(w));
  return tetrahedralize(set, solid, Tetrahedralization::automatic);
}

/// All systems of power cells and, where there is a triangulation, of regular tetrahedra, whole boundaries held or
/// free.
struct Patch {
  std::string name;
  System system;
  std::vector<char> is_held = {};  // per particle of tetrahedra, where some are
};

/// Largest force on particles that are free [N].
double largest_free(const Patch& patch, const Forces& forces) {
  std::vector<Double4> free;
  for (std::size_t a = 0; a < forces.total().size(); ++a)
    if (patch.is_held.empty() || !patch.is_held[a]) free.push_back(forces.total()[a]);
  return largest(free);
}

std::vector<Patch> patches(const Constrain& projection, const Material& m = rubber()) {
  std::vector<Patch> all;
  for (const Integration integration : integrations)
    for (Body& b : bodies()) all.push_back({b.name, system_with(b, projection, m, integration)});
  if (!has_delaunay()) return all;
  const Solid solid = box({1, 1, 1});
  const TetrahedralMesh mesh = regular_tetrahedra(solid, 7);
  std::vector<ParticleConstraint> held;
  std::vector<char> held_particles;
  for (Index a = 0; a < static_cast<Index>(mesh.points.size()); ++a) {
    const Vec3& X = mesh.points[static_cast<std::size_t>(a)];
    const double inside = std::min({X.x, X.y, X.z, 1.0 - X.x, 1.0 - X.y, 1.0 - X.z});
    const Mat3 D = projection(X, {});
    const bool is_held = inside < 1e-9 && !is_zero(D);
    if (is_held) held.push_back({a, D});
    held_particles.push_back(is_held);
  }
  for (const bool by_cells : {false, true}) {
    Discretization d = discretize_delaunay(mesh, held);
    if (by_cells) d.measure = measure_of_dual_cells(mesh);
    all.push_back({by_cells ? "tetrahedra, cell" : "tetrahedra", system_of(std::move(d), m), held_particles});
  }
  return all;
}

TEST(PowerCells, KeepTheIdentities) {
  for (Body& b : bodies()) {
    EXPECT_GT(b.most_unequal(), 0.1) << b.name;
    for (const Constrain& projection : {Constrain(nothing), Constrain(everything)}) {
      constrain(b, projection);
      const Discretization d = discretize(Method::consistent, b.body);
      for (const auto& [name, value] : identities_of_voronoi(d, b.body.cells, b.volume))
        EXPECT_LT(value, 1e-11) << b.name << ": " << name;
    }
  }
}

/// Patch test A: a linear motion gives the exact F, and forces in equilibrium.
TEST(PowerCells, PassPatchTestA) {
  for (const Patch& patch : patches(everything)) {
    const System& s = patch.system;
    State state = reference_state(s);
    move(state, s, linear);
    Forces forces(s);
    forces.evaluate(state, {walls_of(s, linear), {}, {}}, 0.0);
    for (const auto& F : forces.deformation_gradient())
      EXPECT_LT(size_of(to_mat3(F) - identity() - patch_gradient), 1e-13) << patch.name;
    const double held = std::max(largest(forces.reactions()), largest(forces.total()));
    EXPECT_GT(held, 1.0) << patch.name;
    EXPECT_LT(largest_free(patch, forces), 1e-9 * held) << patch.name;
  }
}

/// Patch test C: tractions P N on free faces balance a constant stress.
TEST(PowerCells, PassPatchTestC) {
  for (const auto& [name, s, is_held] : patches(nothing)) {
    State state = reference_state(s);
    move(state, s, linear);
    const std::vector<NodalForce> loads = loads_of_stress(s, patch_stress());
    Forces forces(s);
    forces.evaluate(state, {{}, loads, {}}, 0.0);
    EXPECT_LT(largest(forces.total()), 1e-9 * largest(loads)) << name;
  }
}

/// Forces and torques of a free body add up to nothing, however it is deformed.
TEST(PowerCells, KeepMomenta) {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  for (const auto& [name, s, is_held] : patches(nothing, m)) {
    State state = reference_state(s);
    move(state, s, [](const Vec3& X) { return wavy((1.0 / 6.0) * X) * 6.0; });
    Forces forces(s);
    forces.evaluate(state, {{}, {}, {}}, 0.0);
    const Resultant sum = resultant(state, forces);
    EXPECT_LT(norm(sum.force), 1e-12 * sum.size) << name;
    EXPECT_LT(norm(sum.torque), 1e-11 * sum.size) << name;
  }
}

/// F, forces and reactions against a second implementation, term by term.
TEST(PowerCells, HaveTheForcesOfTheirFacesPositions) {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  Body b = in_solid("box", box({1, 1, 1}), {3, 3, 3}, 9);
  constrain(b, mixed);
  const ConsistentReference reference(b.body);
  const std::vector<Vec3> x = noisy(b.body.X, wavy, 0.02);
  std::vector<Vec3> walls;
  for (const BoundaryFace& f : b.body.cells.boundary) walls.push_back(wavy(f.centroid));
  const ConsistentReferenceForces expected(reference, b.body, m, x, walls);
  const System s = system_of(discretize(Method::consistent, b.body), m);
  State state = reference_state(s);
  for (std::size_t a = 0; a < x.size(); ++a) state.x[a] = to_kernel(x[a]);
  std::vector<Vec3> node_walls;
  for (const BoundaryNode& f : s.d.nodes) node_walls.push_back(walls[static_cast<std::size_t>(f.site)]);
  Forces forces(s);
  forces.evaluate(state, {node_walls, {}, {}}, 0.0);
  for (std::size_t a = 0; a < x.size(); ++a)
    EXPECT_LT(size_of(to_mat3(forces.deformation_gradient()[a]) - expected.F[a]), 1e-12) << a;
  EXPECT_LT(relative_difference(expected.particles, to_vectors(forces.total())), 1e-12);
}

void expect_forces_of_potential(const System& s) {
  const std::vector<Vec3> walls = walls_of(s, wavy);
  const auto potential = [&](State state) {
    Forces forces(s);
    forces.evaluate(state, {walls, {}, {}}, 0.0);
    return forces.sums().internal + forces.sums().contact;
  };
  State state = reference_state(s);
  move(state, s, wavy);
  Forces forces(s);
  forces.evaluate(state, {walls, {}, {}}, 0.0);
  const double scale = largest(forces.total()), h = 1e-5;
  for (Index a = 0; a < s.particles(); ++a)
    for (int i = 0; i < 3; ++i) {
      State plus = state, minus = state;
      plus.x[static_cast<std::size_t>(a)][i] += h;
      minus.x[static_cast<std::size_t>(a)][i] -= h;
      const double slope = (potential(plus) - potential(minus)) / (2.0 * h);
      EXPECT_NEAR(forces.total()[static_cast<std::size_t>(a)][i], -slope, 1e-7 * scale) << "particle " << a;
    }
}

/// Forces are minus the derivative of the energy.
TEST(PowerCells, HaveForcesFromAPotential) {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  for (const Integration integration : integrations) {
    Body b = in_solid("box", box({1, 1, 1}), small_cube(integration), 5);
    const System s = system_with(b, mixed, m, integration);
    EXPECT_TRUE(!s.second_order || s.second_order->unresolved.empty());
    expect_forces_of_potential(s);
  }
}

Vec3 quadratic(const Vec3& X) { return X + Vec3{0.1 * X.x * X.x - 0.2 * X.y * X.z, 0.15 * X.y * X.y, 0.2 * X.x * X.y}; }

Mat3 quadratic_gradient(const Vec3& X) {
  return {{1.0 + 0.2 * X.x, -0.2 * X.z, -0.2 * X.y, 0.0, 1.0 + 0.3 * X.y, 0.0, 0.2 * X.y, 0.2 * X.x, 1.0}};
}

/// The largest error of F as the mean over a cell.
double error_of_quadratic_motion(Body& b, Integration integration) {
  const System s = system_with(b, nothing, rubber(), integration);
  State state = reference_state(s);
  move(state, s, quadratic);
  Forces forces(s);
  forces.evaluate(state, {{}, {}, {}}, 0.0);
  double worst = 0.0;
  for (std::size_t a = 0; a < b.body.X.size(); ++a)
    worst = std::max(worst,
                     size_of(to_mat3(forces.deformation_gradient()[a]) - quadratic_gradient(b.body.cells.centroid[a])));
  return worst;
}

/// With second order F is the mean of its exact values over power cells too, for any motion that is quadratic.
TEST(PowerCells, FollowQuadraticMotionWithSecondOrder) {
  Body b = in_solid("box", box({1, 1, 1}), {5, 5, 5}, 3);
  EXPECT_GT(b.most_unequal(), 0.1);
  EXPECT_LT(error_of_quadratic_motion(b, Integration::second_order), 1e-11);
  EXPECT_GT(error_of_quadratic_motion(b, Integration::nodal), 1e-3);
}

}  // namespace
}  // namespace tessera::test
