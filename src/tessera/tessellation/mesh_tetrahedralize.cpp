#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "tessera/base/error.hpp"
#include "tessera/parallel/parallel.hpp"
#include "tessera/tessellation/delaunay_fill.hpp"
#include "tessera/tessellation/delaunay_weights.hpp"
#include "tessera/tessellation/lattice_split.hpp"
#include "tessera/tessellation/mesh_boundary.hpp"
#include "tessera/tessellation/tetrahedra.hpp"

namespace tessera {
namespace {

constexpr double volume_tolerance = 1e-10;  // of the solid's volume
constexpr double plane_tolerance = 1e-9;    // of the solid's size

constexpr const char* cure =
    "particles must lie on every side, edge and corner of the solid, close enough to resolve them (a lattice with "
    "planes through "
    "every edge, finer or less jittered), or give a tetrahedral mesh file";

std::string at(const Vec3& X) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", X.x, X.y, X.z); }

constexpr const char* cure_of_radii =
    "the power cell of each is empty: make the radii more alike or the distances larger";

std::string with_radius(const PointSet& set, std::size_t i) {
  return fmt::format("particle {} at {} m, radius {:g} m", i, at(set.points[i]), set.radius[i]);
}

/// The particle in whose power cell X lies.
std::size_t owner_of(const Vec3& X, const PointSet& set) {
  const auto power = [&](std::size_t i) { return norm2(X - set.points[i]) - set.radius[i] * set.radius[i]; };
  std::size_t owner = 0;
  for (std::size_t i = 1; i < set.points.size(); ++i)
    if (power(i) < power(owner)) owner = i;
  return owner;
}

/// How a particle without a tetrahedron is called, and what is in its way.
std::string left_out(const PointSet& set, std::size_t i) {
  if (set.radius.empty()) return fmt::format("particle {} at {}", i, at(set.points[i]));
  const std::size_t owner = owner_of(set.points[i], set);
  return with_radius(set, i) + (owner == i ? "" : ", which lies in the power cell of " + with_radius(set, owner));
}

void refuse_left_out_points(const TetrahedralMesh& mesh, const PointSet& set) {
  std::vector<char> used(mesh.points.size(), 0);
  for (const Tetrahedron& t : mesh.tetrahedra)
    for (const Index v : t) used[static_cast<std::size_t>(v)] = 1;
  const auto first = std::find(used.begin(), used.end(), 0);
  if (first == used.end()) return;
  const auto i = static_cast<std::size_t>(first - used.begin());
  throw GeometryError(fmt::format("{} of {} particles belong to no tetrahedron, first {}: {}",
                                  std::count(used.begin(), used.end(), 0), used.size(), left_out(set, i),
                                  set.radius.empty() ? cure : cure_of_radii));
}

double volume_of(const TetrahedralMesh& mesh) {
  return parallel::sum<double>(static_cast<std::int64_t>(mesh.tetrahedra.size()), [&](std::int64_t i) {
    return six_volume(mesh.tetrahedra[static_cast<std::size_t>(i)], mesh.points) / 6.0;
  });
}

/// The outer faces with their sides; a face on no side shows where the solid is not filled, or overfilled.
std::vector<BoundaryTriangle> boundary_of(const TetrahedralMesh& mesh, const Solid& solid) {
  const double tolerance = plane_tolerance * norm(solid.upper - solid.lower);
  std::vector<BoundaryTriangle> boundary;
  for (const Triangle& face : outer_faces(mesh.tetrahedra)) {
    boundary.push_back({face, side_of(face, mesh.points, solid, tolerance)});
    if (boundary.back().side >= 0) continue;
    throw GeometryError(
        fmt::format("the tetrahedra do not fill the solid (volume {:.12g} of {:.12g} m3): the outer face of particles "
                    "{} at {} lies on "
                    "none of its sides; {}",
                    volume_of(mesh), solid.volume, fmt::join(face, ", "), at(centroid(face, mesh.points)), cure));
  }
  return boundary;
}

void refuse_wrong_volume(const TetrahedralMesh& mesh, const Solid& solid) {
  const double volume = volume_of(mesh);
  if (std::abs(volume - solid.volume) <= volume_tolerance * solid.volume) return;
  throw GeometryError(fmt::format("the tetrahedra fill {:.12g} m3 of the solid's {:.12g} m3 ({:+.3g} m3 too {}): {}",
                                  volume, solid.volume, volume - solid.volume,
                                  volume < solid.volume ? "little" : "much", cure));
}

TetrahedralMesh checked(const PointSet& set, const Solid& solid, std::vector<Tetrahedron> tetrahedra) {
  TetrahedralMesh mesh;
  mesh.points = set.points;
  mesh.tetrahedra = std::move(tetrahedra);
  put_in_order(mesh.tetrahedra);
  refuse_left_out_points(mesh, set);
  mesh.boundary = boundary_of(mesh, solid);
  refuse_wrong_volume(mesh, solid);
  for (const Side& side : solid.sides) mesh.side_names.push_back(side.names);
  return mesh;
}

/// Delaunay tetrahedra know nothing of re-entrant edges and may cut through the notch where jitter is large; then the
/// boundary is protected by weights, as light ones as will do.
TetrahedralMesh by_delaunay(const PointSet& set, const Solid& solid) {
  std::exception_ptr first;
  for (const double strength : {0.0, 0.1, 0.2, 0.3, 0.4}) {
    try {
      std::vector<double> weights = boundary_weights(set.points, solid, strength);
      for (std::size_t i = 0; i < set.radius.size(); ++i) weights[i] += set.radius[i] * set.radius[i];
      return checked(set, solid, delaunay_fill(set.points, solid, weights));
    } catch (const GeometryError&) {
      if (!first) first = std::current_exception();
    }
    if (solid.pieces.size() == 1) break;  // convex: no weights can help
  }
  std::rethrow_exception(first);
}

}  // namespace

TetrahedralMesh tetrahedralize(const PointSet& points, const Solid& solid, Tetrahedralization how) {
  if (!points.radius.empty()) {
    if (how == Tetrahedralization::split)
      throw GeometryError(
          "cells of a lattice are split without regard to radii; take method.tetrahedra = \"delaunay\"");
    return by_delaunay(points, solid);
  }
  if (how == Tetrahedralization::split || (how == Tetrahedralization::automatic && !has_delaunay()))
    return checked(points, solid, split_lattice(points, solid));
  return by_delaunay(points, solid);
}

}  // namespace tessera
