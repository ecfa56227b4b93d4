#include "tessera/discretization/delaunay.hpp"

#include <array>

#include "tessera/discretization/rows.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {

namespace {

const Vec3& point(const TetrahedralMesh& mesh, Index i) { return mesh.points[static_cast<std::size_t>(i)]; }

/// vol_t grad N_k is a third of the area vector of the face opposite to vertex k, pointing inwards.
std::array<Vec3, 4> volume_gradients(const std::array<Vec3, 4>& x) {
  const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
  const Vec3 g1 = (1.0 / 6.0) * cross(e2, e3), g2 = (1.0 / 6.0) * cross(e3, e1), g3 = (1.0 / 6.0) * cross(e1, e2);
  return {-(g1 + g2 + g3), g1, g2, g3};
}

std::array<Vec3, 4> corners(const TetrahedralMesh& mesh, const std::array<Index, 4>& t) {
  return {point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2]), point(mesh, t[3])};
}

double volume_of(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& gradient) {
  return dot(gradient[1], x[1] - x[0]);
}

/// The tetrahedra at each particle, ascending.
Csr<Index> tetrahedra_at_particles(const TetrahedralMesh& mesh) {
  Csr<Index> at;
  at.offset.assign(mesh.points.size() + 1, 0);
  for (const auto& t : mesh.tetrahedra)
    for (const Index a : t) ++at.offset[static_cast<std::size_t>(a)];
  // The offsets are the ends of the rows now; filling from the back moves them to the beginnings.
  Offset end = 0;
  for (Offset& offset : at.offset) offset = end += offset;
  at.value.resize(static_cast<std::size_t>(end));
  for (std::size_t i = mesh.tetrahedra.size(); i-- > 0;)
    for (const Index a : mesh.tetrahedra[i])
      at.value[static_cast<std::size_t>(--at.offset[static_cast<std::size_t>(a)])] = static_cast<Index>(i);
  return at;
}

struct BondEntry {
  Index b;
  Vec3 B;
};

/// V_a = sum_t vol_t / 4 and B_ab = sum_t vol_t / 4 grad N_b over the tetrahedra t at a, [D 27].
Csr<BondEntry> rows_of(Discretization& d, const TetrahedralMesh& mesh) {
  const Csr<Index> at = tetrahedra_at_particles(mesh);
  return parallel::collect_rows<BondEntry>(d.particles(), [&](Index a, parallel::RowCollector<BondEntry>& out) {
    thread_local RowBuffer row;
    double& V_a = d.volume[static_cast<std::size_t>(a)];
    for (const Index i : at.row(a)) {
      const std::array<Index, 4>& t = mesh.tetrahedra[static_cast<std::size_t>(i)];
      const std::array<Vec3, 4> x = corners(mesh, t), gradient = volume_gradients(x);
      V_a += 0.25 * volume_of(x, gradient);
      for (std::size_t b = 0; b < 4; ++b)
        if (t[b] != a) row.add(t[b], 0.25 * gradient[b]);
    }
    row.drain([&out](Index b, const Vec3& B) { out.add({b, B}); });
  });
}

void build_bonds(Discretization& d, const TetrahedralMesh& mesh) {
  d.body_volume = parallel::sum<double>(static_cast<std::int64_t>(mesh.tetrahedra.size()), [&](std::int64_t i) {
    const std::array<Vec3, 4> x = corners(mesh, mesh.tetrahedra[static_cast<std::size_t>(i)]);
    return volume_of(x, volume_gradients(x));
  });
  Csr<BondEntry> rows = rows_of(d, mesh);
  Bonds& bonds = d.bonds;
  bonds.offset = std::move(rows.offset);
  bonds.neighbour.resize(rows.value.size());
  bonds.B_ab.resize(rows.value.size());
  parallel::for_each(static_cast<std::int64_t>(rows.value.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    bonds.neighbour[k] = rows.value[k].b;
    bonds.B_ab[k] = rows.value[k].B;
  });
  rows = {};
  // A_ab = 2 (|B_ab| + |B_ba|), [D 60].
  bonds.area_over_length.resize(bonds.neighbour.size());
  parallel::for_each(d.particles(), [&](std::int64_t row) {
    const auto a = static_cast<Index>(row);
    for (Offset i = bonds.begin(a); i < bonds.end(a); ++i) {
      const auto k = static_cast<std::size_t>(i);
      bonds.area_over_length[k] = 2.0 * (norm(bonds.B_ab[k]) + norm(bonds.B_ba(a, i))) / norm(d.branch(a, i));
    }
  });
}

void build_sites(Discretization& d, const TetrahedralMesh& mesh) {
  for (const BoundaryTriangle& t : mesh.boundary) {
    const Vec3 &a = point(mesh, t.vertices[0]), &b = point(mesh, t.vertices[1]), &c = point(mesh, t.vertices[2]);
    const Vec3 area = 0.5 * cross(b - a, c - a);
    const double A = norm(area);
    for (Index vertex : t.vertices) {
      d.sites.push_back({point(mesh, vertex), area / A, (1.0 / 3.0) * (a + b + c), t.side, vertex, t.vertices});
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
