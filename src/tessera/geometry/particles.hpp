#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/index.hpp"
#include "tessera/geometry/solid.hpp"
#include "tessera/geometry/surface_index.hpp"

namespace tessera {

/// Cubic lattice over the bounding box of the solid: either counts or a spacing [m].
struct LatticeSpec {
  std::optional<std::array<int, 3>> counts;
  std::optional<double> spacing;
  double jitter = 0.0;  // largest random move, in spacings, each direction; 0 to 0.49
  std::uint64_t seed = 1;
};

/// Points from a CSV file with the header x,y,z [m].
struct PointFileSpec {
  std::string path;
};

/// A tetrahedral mesh, Gmsh .msh or VTK .vtu (delaunay only).
struct MeshFileSpec {
  std::string path;
};

struct ParticleSpec {
  std::variant<LatticeSpec, PointFileSpec, MeshFileSpec> source;
  Origin origin;
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
  std::vector<Vec3> points;        // [m]
  std::optional<Lattice> lattice;  // set for lattices only
};

/// Places particles in `solid`. The same specification gives the same points on every machine.
/// Throws GeometryError that names the particles and their positions when points lie outside, coincide, or
/// are closer than 1e-6 of the mean spacing; InputError when a lattice leaves no particle in the solid.
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
