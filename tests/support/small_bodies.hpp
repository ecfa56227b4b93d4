#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/delaunay.hpp"
#include "tessera/discretization/moved_means.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/geometry/particles.hpp"
#include "tessera/mechanics/forces.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera::test {

enum class Method { delaunay, consistent, variational, quasi_static };

/// Where the energy of a cell is taken.
enum class Integration { nodal, cell, second_order };

inline std::string name_of(Method m) {
  switch (m) {
    case Method::delaunay:
      return "delaunay";
    case Method::consistent:
      return "consistent";
    case Method::variational:
      return "variational";
    case Method::quasi_static:
      return "quasi_static";
  }
  return "";
}

inline std::string name_of(Integration i) {
  switch (i) {
    case Integration::nodal:
      return "nodal";
    case Integration::cell:
      return "cell";
    case Integration::second_order:
      return "second_order";
  }
  return "";
}

/// Cells along an edge of a small cube: second derivatives need four, the others do with three.
inline int cells_along(Integration i) { return i == Integration::second_order ? 4 : 3; }
inline std::array<int, 3> small_cube(Integration i) { return {cells_along(i), cells_along(i), cells_along(i)}; }

/// What tests go through.
struct Kind {
  Method method;
  Integration integration = Integration::nodal;
};

inline std::string name_of(const Kind& k) { return name_of(k.method) + "_" + name_of(k.integration); }

inline Solid box(const Vec3& upper) {
  Shape shape;
  shape.kind = BoxShape{{0, 0, 0}, upper};
  return build_solid(shape);
}

/// The L-block of [V], section 6.3, as a polygon.
inline Solid l_block() {
  Shape shape;
  shape.kind = PolygonShape{{{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 10}, {0, 10}}, 0.0, 3.0};
  return build_solid(shape);
}

inline PointSet lattice(const Solid& solid, std::array<int, 3> counts, double jitter, std::uint64_t seed, Placement p) {
  LatticeSpec spec;
  spec.counts = counts;
  spec.jitter = jitter;
  spec.seed = seed;
  return place_particles({spec, {}}, solid, p);
}

/// The projection of each boundary face as a function of its centroid and normal.
using Constrain = std::function<Mat3(const Vec3& centroid, const Vec3& normal)>;

/// Tetrahedra on a lattice with `counts` cells, jittered.
inline TetrahedralMesh tetrahedra(const Solid& solid, std::array<int, 3> counts, double jitter, std::uint64_t seed) {
  for (int& n : counts) ++n;
  return tetrahedralize(lattice(solid, counts, jitter, seed, Placement::vertices), solid,
                        Tetrahedralization::automatic);
}

/// Points, their cells and the projection of each boundary face.
struct VoronoiBody {
  std::vector<Vec3> X;
  Cells cells;
  std::vector<Mat3> D;
};

inline VoronoiBody voronoi_body(const Solid& solid, std::array<int, 3> counts, double jitter, std::uint64_t seed,
                                const Constrain& constrain) {
  VoronoiBody body;
  body.X = lattice(solid, counts, jitter, seed, Placement::cell_centres).points;
  body.cells = voronoi_cells(body.X, solid, Moments::second_of_faces);
  for (const BoundaryFace& f : body.cells.boundary) body.D.push_back(constrain(f.centroid, normalized(f.area)));
  return body;
}

inline Discretization discretize(Method method, const VoronoiBody& body, Integration integration = Integration::nodal) {
  const FaceOrder order = integration == Integration::second_order ? FaceOrder::quadratic : FaceOrder::linear;
  Discretization d =
      method == Method::consistent
          ? discretize_consistent(body.X, body.cells, body.D, order)
          : discretize_ghosts(body.X, body.cells, body.D,
                              method == Method::variational ? GhostForce::variational : GhostForce::quasi_static);
  if (integration == Integration::cell) d.measure = measure_of_cells(body.cells);
  if (d.measure && method == Method::variational) d.measure->moved = moved_means(d, body.cells);
  return d;
}

/// A test of second order must not be one of cell integration.
inline void require_resolved(const Discretization& d) {
  const std::vector<char>& resolved = d.second_order->derivatives.resolved;
  if (std::count(resolved.begin(), resolved.end(), 1) == 0) throw std::logic_error("no second derivative is resolved");
}

/// A box or L-block discretized; for delaunay `constrain` acts on particles, with the normal zero.
inline Discretization discretize(Method method, const Solid& solid, std::array<int, 3> counts, double jitter,
                                 std::uint64_t seed, const Constrain& constrain,
                                 Integration integration = Integration::nodal) {
  if (method != Method::delaunay) {
    Discretization d = discretize(method, voronoi_body(solid, counts, jitter, seed, constrain), integration);
    if (integration == Integration::second_order) require_resolved(d);
    return d;
  }
  const TetrahedralMesh mesh = tetrahedra(solid, counts, jitter, seed);
  std::vector<ParticleConstraint> constraints;
  for (Index a = 0; a < static_cast<Index>(mesh.points.size()); ++a) {
    const Mat3 D = constrain(mesh.points[static_cast<std::size_t>(a)], Vec3{});
    if (!is_zero(D)) constraints.push_back({a, D});
  }
  Discretization d = discretize_delaunay(mesh, constraints);
  if (integration == Integration::cell) d.measure = measure_of_dual_cells(mesh);
  return d;
}

inline Discretization discretize(const Kind& kind, const Solid& solid, std::array<int, 3> counts, double jitter,
                                 std::uint64_t seed, const Constrain& constrain) {
  return discretize(kind.method, solid, counts, jitter, seed, constrain, kind.integration);
}

inline Mat3 nothing(const Vec3&, const Vec3&) { return {}; }
inline Mat3 everything(const Vec3&, const Vec3&) { return identity(); }

/// Symmetric, antisymmetric, component-wise, fixed and free faces that meet at edges and corners of a unit box.
inline Mat3 mixed(const Vec3& C, const Vec3& N) {
  if (C.x < 1e-9) return outer(N, N);
  if (C.y < 1e-9) return identity() - outer(N, N);
  if (C.z < 1e-9) return identity();
  if (C.x > 1.0 - 1e-9) return diagonal(0, 1, 0);
  return {};
}

inline Material rubber(double young = 1e6, double poisson = 0.3, double density = 1000.0) {
  Material m;
  m.name = "rubber";
  m.young = young;
  m.poisson = poisson;
  m.density = density;
  m.law = NeoHookean::from_young_poisson(young, poisson);
  return m;
}

template <class Law>
Material made_of(const Law& law) {
  Material m = rubber();
  m.law = law;
  return m;
}

/// One material of every law but the neo-Hookean one; the last flows.
inline std::vector<Material> other_materials() {
  return {made_of(SaintVenantKirchhoff::from_young_poisson(1e6, 0.3)), made_of(MooneyRivlin{1.5e5, 0.5e5, {8e5}}),
          made_of(Ogden{{{2e5, 1.5}, {-0.5e5, -2.0}}, {8e5}}),
          made_of(J2Plasticity::from_young_poisson(1e6, 0.3, 1e4, 1e5))};
}

/// Tiles so small that even small bodies have several, with rims.
constexpr Index small_tiles = 11;

inline System system_of(Discretization d, const Material& m, Index particles_per_tile = small_tiles,
                        Volumetric volumetric = Volumetric::standard) {
  const std::vector<Index> material(d.X.size(), 0);
  return make_system(std::move(d), {m}, material, particles_per_tile, volumetric);
}

inline std::vector<Vec3> walls_of(const System& s, const std::function<Vec3(const Vec3&)>& motion) {
  std::vector<Vec3> walls;
  for (const BoundaryNode& f : s.d.nodes) walls.push_back(motion(f.wall));
  return walls;
}

inline void move(State& state, const System& s, const std::function<Vec3(const Vec3&)>& motion) {
  for (std::size_t a = 0; a < s.d.X.size(); ++a) state.x[a] = to_kernel(motion(s.d.X[a]));
}

/// A smooth, strongly nonlinear motion for tests of forces.
inline Vec3 wavy(const Vec3& X) {
  return X + Vec3{0.1 * std::sin(2.0 * X.y) + 0.05 * X.x * X.x, 0.08 * std::cos(3.0 * X.x) * X.z,
                  -0.07 * X.x * X.y + 0.04 * X.z};
}

}  // namespace tessera::test
