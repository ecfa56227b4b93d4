#include "tessera/discretization/delaunay.hpp"

#include <algorithm>

#include "tessera/discretization/rows.hpp"

namespace tessera {

namespace {

const Vec3& point(const TetrahedralMesh& mesh, Index i) { return mesh.points[static_cast<std::size_t>(i)]; }

/// One contribution vol_t / 4 grad N_b to the gradient vector B_ab (b = a included).
struct Contribution {
  Index a = 0;
  Index b = 0;
  Vec3 B;
};

/// vol_t grad N_k is a third of the area vector of the face opposite to vertex k, pointing inwards.
std::array<Vec3, 4> volume_gradients(const std::array<Vec3, 4>& x) {
  const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
  const Vec3 g1 = (1.0 / 6.0) * cross(e2, e3), g2 = (1.0 / 6.0) * cross(e3, e1), g3 = (1.0 / 6.0) * cross(e1, e2);
  return {-(g1 + g2 + g3), g1, g2, g3};
}

std::vector<Contribution> contributions(Discretization& d, const TetrahedralMesh& mesh) {
  std::vector<Contribution> list;
  list.reserve(16 * mesh.tetrahedra.size());
  for (const auto& t : mesh.tetrahedra) {
    const std::array<Vec3, 4> x{point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2]), point(mesh, t[3])};
    const std::array<Vec3, 4> gradient = volume_gradients(x);
    const double volume = dot(gradient[1], x[1] - x[0]);
    for (Index a : t) {
      d.volume[static_cast<std::size_t>(a)] += 0.25 * volume;
      for (std::size_t b = 0; b < 4; ++b) list.push_back({a, t[b], 0.25 * gradient[b]});
    }
    d.body_volume += volume;
  }
  return list;
}

void build_bonds(Discretization& d, const TetrahedralMesh& mesh) {
  const std::vector<Contribution> list = contributions(d, mesh);
  const Csr<Contribution> rows =
      group_by_row<Contribution>(d.particles(), list, [](const Contribution& c) { return c.a; });
  RowBuffer row;
  for (Index a = 0; a < d.particles(); ++a) {
    for (const Contribution& c : rows.row(a)) row.add(c.b, c.B);
    row.drain([&](Index b, const Vec3& B) {
      if (b == a) return;
      d.bonds.neighbour.push_back(b);
      d.bonds.B_ab.push_back(B);
    });
    d.bonds.offset.push_back(static_cast<Offset>(d.bonds.neighbour.size()));
  }
  complete_bonds(d.bonds);
  // A_ab = 2 (|B_ab| + |B_ba|), [D 60].
  d.bonds.area_over_length.resize(d.bonds.neighbour.size());
  for (Index a = 0; a < d.particles(); ++a)
    for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i) {
      const auto k = static_cast<std::size_t>(i);
      d.bonds.area_over_length[k] = 2.0 * (norm(d.bonds.B_ab[k]) + norm(d.bonds.B_ba[k])) / norm(d.branch(a, i));
    }
}

void build_sites(Discretization& d, const TetrahedralMesh& mesh) {
  for (const BoundaryTriangle& t : mesh.boundary) {
    const Vec3 &a = point(mesh, t.vertices[0]), &b = point(mesh, t.vertices[1]), &c = point(mesh, t.vertices[2]);
    const Vec3 area = 0.5 * cross(b - a, c - a);
    const double A = norm(area);
    for (Index vertex : t.vertices) {
      d.sites.push_back({point(mesh, vertex), area / A, (1.0 / 3.0) * (a + b + c), t.side, vertex});
      // The integral of N_i N_j over a triangle is A/6 for i = j and A/12 otherwise.
      for (Index other : t.vertices) d.load.value.push_back({other, other == vertex ? A / 6.0 : A / 12.0});
      d.load.offset.push_back(static_cast<Offset>(d.load.value.size()));
    }
  }
}

}  // namespace

Discretization discretize_delaunay(const TetrahedralMesh& mesh, std::span<const ParticleConstraint> constraints) {
  Discretization d;
  d.X = mesh.points;
  d.volume.assign(mesh.points.size(), 0.0);
  build_bonds(d, mesh);
  build_sites(d, mesh);
  d.B_aa = diagonal_vectors(d);
  d.constraints.assign(constraints.begin(), constraints.end());
  return d;
}

}  // namespace tessera
