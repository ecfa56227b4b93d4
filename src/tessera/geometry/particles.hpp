#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/formula.hpp"
#include "tessera/base/index.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/geometry/surface_index.hpp"

namespace tessera {

enum class LatticeKind { cubic, bcc, fcc, hcp };

/// Lattice over the bounding box of the solid, clipped to it. One of counts (of unit cells), spacing and count is set.
struct LatticeSpec {
  std::optional<std::array<int, 3>> counts;
  std::optional<double> spacing;  // cube root of the volume per particle [m]
  double jitter = 0.0;            // largest random move, in spacings, each direction; 0 to 0.49
  std::uint64_t seed = 1;
  LatticeKind kind = LatticeKind::cubic;
  std::optional<Index> count = {};  // of particles, as near as whole unit cells come to it
};

/// How many particles: as many as asked for, or one for spacing^3 of the volume (spacing^2 of the area in a plane).
struct Amount {
  std::optional<Index> count;
  std::optional<double> spacing;  // [m]

  /// Their number in a solid of this size [m3], or [m2] in two dimensions; at least one.
  double in(double size, int dimension) const;
};

/// Random points no two of which are near each other (Poisson discs).
struct RandomSpec {
  Amount amount;
  std::uint64_t seed = 1;
};

/// Points that are moved to the centroids of their Voronoi cells, again and again.
struct RelaxedSpec {
  Amount amount;
  std::uint64_t seed = 1;
  int iterations = 100;         // at most
  double tolerance = 0.01;      // enough as root mean square of the distances to the centroids, in spacings
  std::optional<Formula> size;  // local spacing up to a factor: only ratios count
};

/// Points from a CSV file with the header x,y,z [m], and their radii if it has a column radius [m].
struct PointFileSpec {
  std::string path;
};

/// A tetrahedral mesh, Gmsh .msh or VTK .vtu (delaunay only).
struct MeshFileSpec {
  std::string path;
};

/// Which program fills what a surface encloses with tetrahedra; automatic: CGAL where the build has it, else Gmsh.
enum class Mesher { automatic, cgal, gmsh };

/// What a case wants of the mesher, beside the spacing or the number of particles.
struct MesherSpec {
  std::optional<Mesher> mesher;
  std::optional<Formula> size;  // local length of edges up to a factor: only ratios count
};

struct ParticleSpec {
  std::variant<LatticeSpec, PointFileSpec, MeshFileSpec, RandomSpec, RelaxedSpec> source;
  Origin origin;
  int dimension = 3;                   // 2: irregular arrangements lie in the middle plane of a slab along z
  std::optional<Formula> radius = {};  // of power cells [m], taken where the particles are in the end
  MesherSpec mesher = {};              // for delaunay bodies in surfaces only
};

/// Where a formulation wants its particles: in the centres of lattice cells (voronoi) or on the lattice's
/// vertices, boundary included (delaunay).
enum class Placement { cell_centres, vertices };

/// The lattice behind a set of points, kept because the split lattice needs it.
struct Lattice {
  std::array<Index, 3> nodes{};  // points per direction, occupied or not
  Vec3 origin;                   // position of node (0,0,0) [m]
  Vec3 spacing;                  // [m]
  std::vector<Index> particle;   // particle of node i + nx (j + ny k), or -1 where the lattice has none
};

struct PointSet {
  std::vector<Vec3> points;         // [m]
  std::optional<Lattice> lattice;   // set for lattices only
  std::vector<double> radius = {};  // of power cells [m], one for each point or none
};

/// Places particles in `solid`. The same specification gives the same points on every machine. Relaxed particles are
/// in their first places only: relax() moves them.
/// Throws GeometryError that names the particles and their positions when points lie outside, coincide, or
/// are closer than 1e-6 of the mean spacing; InputError when a lattice leaves no particle in the solid, and for
/// vertices that are to lie otherwise than on a cubic lattice or as in a file.
PointSet place_particles(const ParticleSpec& spec, const Solid& solid, Placement placement);

/// Places the centres of Voronoi cells in the solid that a surface encloses. Of a lattice over its bounding box it
/// takes the cell centres that are inside and at least kLeastDepth spacings away from the surface, so that no cell
/// becomes a sliver; jitter brings none nearer than that. Points of a file must lie inside. Errors as above.
PointSet place_particles(const ParticleSpec& spec, const SurfaceIndex& index);

/// How near to a surface cell centres of a lattice may be, in spacings: cells then reach from it over 0.7 to 1.7
/// spacings.
inline constexpr double kLeastDepth = 0.2;

/// A permutation along a space-filling (Hilbert) curve: order[i] is the point that comes i-th.
std::vector<Index> hilbert_order(const std::vector<Vec3>& points);

/// The points in that order.
std::vector<Vec3> permuted(const std::vector<Vec3>& points, const std::vector<Index>& order);

}  // namespace tessera
