#include <algorithm>
#include <cmath>

#include "tessera/discretization/face_positions.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/discretization/voronoi_common.hpp"
#include "tessera/parallel/collect.hpp"

namespace tessera {

namespace {

/// A particle that a widened stencil couples to another beyond its nearest neighbours.
struct DistantPair {
  Index a, b;
};

/// All such pairs, both ways round.
Csr<DistantPair> distant_pairs(const Csr<FaceOfCell>& faces, const FacePositions& positions, const Cells& cells,
                               std::span<const Mat3> D) {
  std::vector<DistantPair> pairs;
  const auto note = [&](Index a, std::span<const FaceTerm> position) {
    const auto row = faces.row(a);
    for (const FaceTerm& t : position) {
      const bool near = t.particle == a || std::any_of(row.begin(), row.end(),
                                                       [&](const FaceOfCell& f) { return f.neighbour == t.particle; });
      if (!near) pairs.push_back({a, t.particle}), pairs.push_back({t.particle, a});
    }
  };
  for (Index i : positions.widened_interior) {
    note(cells.interior[static_cast<std::size_t>(i)].a, positions.interior.row(i));
    note(cells.interior[static_cast<std::size_t>(i)].b, positions.interior.row(i));
  }
  for (Index i : positions.widened_boundary)
    if (is_zero(D[static_cast<std::size_t>(i)]))
      note(cells.boundary[static_cast<std::size_t>(i)].owner, positions.boundary.row(i));
  return group_by_row<DistantPair>(static_cast<Index>(cells.volume.size()), pairs,
                                   [](const DistantPair& p) { return p.a; });
}

/// One bond while a row is put together.
struct BondEntry {
  Index b;
  double area;  // of the common face, zero if there is none
  Vec3 B;
};

class RowAssembler {
 public:
  RowAssembler(const Csr<FaceOfCell>& faces, const FacePositions& positions, const Cells& cells,
               std::span<const Mat3> D)
      : faces_(faces),
        positions_(positions),
        cells_(cells),
        D_(D),
        distant_(distant_pairs(faces, positions, cells, D)) {}

  /// V_a F_a = sum_f c_f (x) A_f over the faces of a, faces with a boundary node left out.
  void operator()(Index a, parallel::RowCollector<BondEntry>& out) const {
    thread_local std::vector<BondEntry> row;
    start(a, row);
    for (const FaceOfCell& g : faces_.row(a)) {
      const auto k = static_cast<std::size_t>(g.face);
      if (g.neighbour >= 0)
        add(a, row, positions_.interior.row(g.face),
            cells_.interior[k].a == a ? cells_.interior[k].area : -cells_.interior[k].area);
      else if (is_zero(D_[k]))
        add(a, row, positions_.boundary.row(g.face), cells_.boundary[k].area);
    }
    for (const BondEntry& entry : row) out.add(entry);
  }

 private:
  void start(Index a, std::vector<BondEntry>& row) const {
    row.clear();
    for (const FaceOfCell& f : faces_.row(a))
      if (f.neighbour >= 0)
        row.push_back({f.neighbour, norm(cells_.interior[static_cast<std::size_t>(f.face)].area), {}});
    if (distant_.row(a).empty()) return;
    const auto nearest = static_cast<std::ptrdiff_t>(row.size());
    for (const DistantPair& p : distant_.row(a)) row.push_back({p.b, 0.0, {}});
    const auto before = [](const BondEntry& l, const BondEntry& r) { return l.b < r.b; };
    std::sort(row.begin() + nearest, row.end(), before);
    row.erase(std::unique(row.begin() + nearest, row.end(),
                          [](const BondEntry& l, const BondEntry& r) { return l.b == r.b; }),
              row.end());
    std::inplace_merge(row.begin(), row.begin() + nearest, row.end(), before);
  }

  static void add(Index a, std::vector<BondEntry>& row, std::span<const FaceTerm> position, const Vec3& A) {
    for (const FaceTerm& t : position) {
      if (t.particle == a) continue;
      const auto it = std::lower_bound(row.begin(), row.end(), t.particle,
                                       [](const BondEntry& entry, Index b) { return entry.b < b; });
      it->B += t.weight * A;
    }
  }

  const Csr<FaceOfCell>& faces_;
  const FacePositions& positions_;
  const Cells& cells_;
  std::span<const Mat3> D_;
  Csr<DistantPair> distant_;
};

void build_bonds(Discretization& d, const RowAssembler& assembler) {
  Csr<BondEntry> rows = parallel::collect_rows<BondEntry>(d.particles(), assembler);
  const std::size_t n = rows.value.size();
  Bonds& bonds = d.bonds;
  bonds.offset = std::move(rows.offset);
  bonds.neighbour.resize(n);
  bonds.B_ab.resize(n);
  bonds.area_over_length.resize(n);
  parallel::for_each(static_cast<std::int64_t>(n), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    bonds.neighbour[k] = rows.value[k].b;
    bonds.B_ab[k] = rows.value[k].B;
    bonds.area_over_length[k] = rows.value[k].area;  // divided by the length below
  });
  rows = {};
  complete_bonds(bonds);
  parallel::for_each(bonds.rows(), [&](std::int64_t a) {
    for (Offset i = bonds.begin(static_cast<Index>(a)); i < bonds.end(static_cast<Index>(a)); ++i)
      bonds.area_over_length[static_cast<std::size_t>(i)] /= norm(d.branch(static_cast<Index>(a), i));
  });
}

/// A node per constrained face: stiffness as of a ghost bond (four times A/L because the displacement is that of the
/// face, half of the ghost's), L not below a quarter of the cell's size.
BoundaryNode constrained_node(const BoundaryFace& f, Index site, const Mat3& D, const Vec3& X_a, double V_a) {
  BoundaryNode node;
  node.owner = f.owner;
  node.site = site;
  node.X = node.wall = f.centroid;
  node.N = normalized(f.area);
  node.area = node.B_af = f.area;
  node.D = D;
  node.wall_share = 1.0;
  const double L = std::max(2.0 * std::abs(dot(node.N, f.centroid - X_a)), 0.25 * std::cbrt(V_a));
  node.area_over_length = 4.0 * norm(f.area) / L;
  return node;
}

void build_boundary(Discretization& d, const FacePositions& positions, const Cells& cells, std::span<const Mat3> D) {
  for (std::size_t i = 0; i < cells.boundary.size(); ++i) {
    const BoundaryFace& f = cells.boundary[i];
    const std::span<const FaceTerm> position = positions.boundary.row(static_cast<Index>(i));
    for (const FaceTerm& t : position) d.load.value.push_back({t.particle, t.weight * norm(f.area)});
    d.load.offset.push_back(static_cast<Offset>(d.load.value.size()));
    if (is_zero(D[i])) continue;
    const auto owner = static_cast<std::size_t>(f.owner);
    d.nodes.push_back(constrained_node(f, static_cast<Index>(i), D[i], d.X[owner], d.volume[owner]));
    for (const FaceTerm& t : position) d.closure.value.push_back({t.particle, 0.0, t.weight});
    d.closure.offset.push_back(static_cast<Offset>(d.closure.value.size()));
  }
}

}  // namespace

Discretization discretize_consistent(std::span<const Vec3> X, const Cells& cells, std::span<const Mat3> D) {
  Discretization d;
  describe_particles(d, X, cells);
  const Csr<FaceOfCell> faces = faces_of_cells(cells);
  const FacePositions positions = face_positions(X, cells, faces, D);
  build_bonds(d, RowAssembler(faces, positions, cells, D));
  build_boundary(d, positions, cells, D);
  d.B_aa = diagonal_vectors(d);
  return d;
}

}  // namespace tessera
