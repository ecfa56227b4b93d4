#include "tessera/tessellation/surface_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tessera/base/error.hpp"
#include "tessera/geometry/surface_index.hpp"
#include "tessera/tessellation/mesh_boundary.hpp"
#include "tessera/tessellation/surface_mesher.hpp"

namespace tessera {

namespace {

constexpr double largest_volume_error = 0.1;  // of the surface's volume
constexpr double most_particles = 1e8;
constexpr double sliver_angle = 10.0;  // [degrees]

std::string at(const Vec3& X) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", X.x, X.y, X.z); }

/// The smallest angle between two faces [degrees].
double smallest_angle(const Tetrahedron& t, std::span<const Vec3> points) {
  static constexpr int opposite[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  std::array<Vec3, 4> N;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [&](int k) { return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    const Vec3 a = corner(opposite[i][0]);
    N[i] = normalized(cross(corner(opposite[i][1]) - a, corner(opposite[i][2]) - a));
  }
  double largest_cosine = -1.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) largest_cosine = std::max(largest_cosine, -dot(N[i], N[j]));
  return std::acos(std::clamp(largest_cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// 3 r_in / r_out.
double quality(const Tetrahedron& t, std::span<const Vec3> points) {
  const auto corner = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
  const Vec3 a = corner(1) - corner(0), b = corner(2) - corner(0), c = corner(3) - corner(0);
  const double six_volumes = dot(a, cross(b, c));
  const double areas = 0.5 * (norm(cross(a, b)) + norm(cross(b, c)) + norm(cross(c, a)) + norm(cross(b - a, c - a)));
  const double inner = 0.5 * six_volumes / areas;
  const double outer =
      norm(norm2(a) * cross(b, c) + norm2(b) * cross(c, a) + norm2(c) * cross(a, b)) / (2.0 * std::abs(six_volumes));
  return 3.0 * inner / outer;
}

void measure(SurfaceMesh& made) {
  made.smallest_angle = 180.0;
  made.smallest_quality = 1.0;
  for (const Tetrahedron& t : made.mesh.tetrahedra) {
    const double angle = smallest_angle(t, made.mesh.points);
    made.volume += six_volume(t, made.mesh.points) / 6.0;
    made.smallest_angle = std::min(made.smallest_angle, angle);
    made.smallest_quality = std::min(made.smallest_quality, quality(t, made.mesh.points));
    if (angle < sliver_angle) ++made.slivers;
  }
}

/// Every edge of the boundary lies between two of its triangles, or between four where parts touch at it.
void refuse_open_boundary(const TetrahedralMesh& mesh) {
  std::vector<std::array<Index, 2>> edges;
  for (const BoundaryTriangle& t : mesh.boundary)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t.vertices[i], b = t.vertices[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i != 2)
      throw GeometryError(fmt::format("the mesh touches itself at the edge from {} to {}; a finer spacing may help",
                                      at(mesh.points[static_cast<std::size_t>(edges[i][0])]),
                                      at(mesh.points[static_cast<std::size_t>(edges[i][1])])));
    i = end;
  }
}

void refuse_lost_volume(const SurfaceMesh& made) {
  if (std::abs(made.volume - made.surface_volume) <= largest_volume_error * made.surface_volume) return;
  throw GeometryError(
      fmt::format("the mesh fills {:.6g} m3 of the {:.6g} m3 inside the surface: parts of it are thinner "
                  "than the spacing can show; make particles.spacing smaller",
                  made.volume, made.surface_volume));
}

std::vector<BoundaryTriangle> boundary_of(const TetrahedralMesh& mesh, const TriangleSurface& surface) {
  const SurfaceIndex index(surface);
  std::vector<BoundaryTriangle> boundary;
  for (const Triangle& face : outer_faces(mesh.tetrahedra)) {
    const Index nearest = index.nearest(centroid(face, mesh.points)).triangle;
    boundary.push_back({face, surface.side[static_cast<std::size_t>(nearest)]});
  }
  return boundary;
}

/// The mesher that is meant by automatic.
Mesher available(Mesher wanted) {
  if (wanted != Mesher::automatic) return wanted;
  if (has_cgal_mesher()) return Mesher::cgal;
  if (has_gmsh()) return Mesher::gmsh;
  throw GeometryError(
      "nothing here can mesh surfaces: this build is without CGAL's Mesh_3 (GPL; build with TESSERA_WITH_CGAL=ON), and "
      "the program gmsh is not on the search path (Debian: apt-get install gmsh); install one of them, or give a mesh "
      "that another program made: particles = { mesh = \"part.msh\" }");
}

void sort_points(RawMesh& raw) {
  std::vector<Index> order(raw.points.size()), place(raw.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  const auto at_order = [&](Index i) { return raw.points[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](Index l, Index r) {
    const Vec3 p = at_order(l), q = at_order(r);
    return std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z};
  });
  std::vector<Vec3> sorted;
  for (const Index i : order) {
    place[static_cast<std::size_t>(i)] = static_cast<Index>(sorted.size());
    sorted.push_back(at_order(i));
  }
  raw.points = std::move(sorted);
  for (Tetrahedron& t : raw.tetrahedra)
    for (Index& v : t) v = place[static_cast<std::size_t>(v)];
}

}  // namespace

SurfaceMesh mesh_surface(const TriangleSurface& surface, const SurfaceMeshSpec& spec) {
  SurfaceMesh made;
  made.surface_volume = volume(surface);
  const double expected = made.surface_volume / std::pow(spec.spacing, 3);
  if (expected > most_particles)
    throw GeometryError(fmt::format("a spacing of {:g} m makes about {:.2g} particles; the most is {:g}", spec.spacing,
                                    expected, most_particles));
  made.mesher = available(spec.mesher);
  const SurfaceFeatures features = surface_features(surface, spec.feature_angle);
  RawMesh raw =
      made.mesher == Mesher::gmsh ? mesh_with_gmsh(surface, features, spec) : mesh_with_cgal(surface, features, spec);
  if (raw.tetrahedra.empty())
    throw GeometryError("the spacing is too coarse to mesh the surface at all; make particles.spacing smaller");
  sort_points(raw);
  made.mesh.points = std::move(raw.points);
  made.mesh.tetrahedra.assign(raw.tetrahedra.begin(), raw.tetrahedra.end());
  put_in_order(made.mesh.tetrahedra);
  made.mesh.boundary = boundary_of(made.mesh, surface);
  for (const std::string& name : surface.side_names) made.mesh.side_names.push_back({name});
  measure(made);
  refuse_lost_volume(made);
  refuse_open_boundary(made.mesh);
  return made;
}

}  // namespace tessera
