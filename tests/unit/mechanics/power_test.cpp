#include <gtest/gtest.h>

#include <random>

#include "support/consistent_reference.hpp"
#include "support/triangle_surfaces.hpp"
#include "tessera/discretization/identities.hpp"
#include "tessera/tessellation/surface_cells.hpp"

namespace tessera::test {
namespace {

const Mat3 gradient{{1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4, 7e-4, 8e-4, 9e-4}};  // [V 52]

Vec3 linear(const Vec3& X) { return X + gradient * X; }

/// Weights of radii up to `largest` [m], so different that faces lie far from the middles of branches.
std::vector<double> weights_up_to(double largest, std::size_t points, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> weights;
  for (std::size_t i = 0; i < points; ++i) {
    const double r = largest * static_cast<double>(random()) / 0x1p32;
    weights.push_back(r * r);
  }
  return weights;
}

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
  b.body.cells = voronoi_cells({b.body.X, weights}, solid);
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
  b.body.cells = surface_cells({b.body.X, weights}, index).cells;
  return b;
}

std::vector<Body> bodies() {
  return {in_solid("box", box({1, 1, 1}), {4, 4, 4}, 3), in_solid("L-block", l_block(), {4, 6, 2}, 4),
          in_surface("ball", ball_surface(1.0, 12, 24), 0.35, 1),
          in_surface("gear", turned(gear_surface(9, 0.4, 1.0, 1.3, 0.5), 0.7), 0.2, 2)};
}

System system_with(Body& b, const Constrain& projection, const Material& m) {
  constrain(b, projection);
  return system_of(discretize(Method::consistent, b.body), m);
}

double largest(const std::vector<Double4>& forces) {
  double f = 0.0;
  for (const Double4& total : forces) f = std::max(f, norm(to_vec3(total)));
  return f;
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
  for (Body& b : bodies()) {
    const System s = system_with(b, everything, rubber());
    State state = reference_state(s);
    move(state, s, linear);
    Forces forces(s);
    forces.evaluate(state, {walls_of(s, linear), {}, {}}, 0.0);
    for (const auto& F : forces.deformation_gradient())
      EXPECT_LT(size_of(to_mat3(F) - identity() - gradient), 1e-13) << b.name;
    double reaction = 0.0;
    for (const Vec3& r : forces.reactions()) reaction = std::max(reaction, norm(r));
    EXPECT_LT(largest({forces.total().begin(), forces.total().end()}), 1e-9 * reaction) << b.name;
  }
}

/// Patch test C: tractions P N on free faces balance a constant stress.
TEST(PowerCells, PassPatchTestC) {
  for (Body& b : bodies()) {
    const System s = system_with(b, nothing, rubber());
    State state = reference_state(s);
    move(state, s, linear);
    const Mat3 P = std::get<NeoHookean>(rubber().law).stress(identity() + gradient);
    std::vector<NodalForce> loads;
    double load = 0.0;
    for (std::size_t i = 0; i < s.d.sites.size(); ++i)
      for (const LoadShare& share : s.d.load.row(static_cast<Index>(i))) {
        loads.push_back({share.particle, share.area * (P * s.d.sites[i].N)});
        load = std::max(load, norm(loads.back().force));
      }
    Forces forces(s);
    forces.evaluate(state, {{}, loads, {}}, 0.0);
    EXPECT_LT(largest({forces.total().begin(), forces.total().end()}), 1e-9 * load) << b.name;
  }
}

/// Forces and torques of a free body add up to nothing, however it is deformed.
TEST(PowerCells, KeepMomenta) {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  for (Body& b : bodies()) {
    const System s = system_with(b, nothing, m);
    State state = reference_state(s);
    const auto motion = [](const Vec3& X) { return wavy((1.0 / 6.0) * X) * 6.0; };
    move(state, s, motion);
    Forces forces(s);
    forces.evaluate(state, {{}, {}, {}}, 0.0);
    Vec3 force, torque;
    double scale = 0.0;
    for (std::size_t a = 0; a < s.d.X.size(); ++a) {
      const Vec3 f = to_vec3(forces.total()[a]);
      force += f;
      torque += cross(to_vec3(state.x[a]), f);
      scale += norm(f);
    }
    EXPECT_LT(norm(force), 1e-12 * scale) << b.name;
    EXPECT_LT(norm(torque), 1e-11 * scale) << b.name;
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

/// Forces are minus the derivative of the energy.
TEST(PowerCells, HaveForcesFromAPotential) {
  Material m = rubber();
  m.contact = {0.8, 1.9};
  Body b = in_solid("box", box({1, 1, 1}), {3, 3, 3}, 5);
  const System s = system_with(b, mixed, m);
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
  const double scale = largest({forces.total().begin(), forces.total().end()}), h = 1e-5;
  for (Index a = 0; a < s.particles(); ++a)
    for (int i = 0; i < 3; ++i) {
      State plus = state, minus = state;
      plus.x[static_cast<std::size_t>(a)][i] += h;
      minus.x[static_cast<std::size_t>(a)][i] -= h;
      const double slope = (potential(plus) - potential(minus)) / (2.0 * h);
      EXPECT_NEAR(forces.total()[static_cast<std::size_t>(a)][i], -slope, 1e-7 * scale) << "particle " << a;
    }
}

}  // namespace
}  // namespace tessera::test
