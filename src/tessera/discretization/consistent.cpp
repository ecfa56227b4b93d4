#include <algorithm>
#include <cmath>
#include <compare>

#include "tessera/discretization/cell_measure.hpp"
#include "tessera/discretization/curved_faces.hpp"
#include "tessera/discretization/face_positions.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/discretization/voronoi_common.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

/// A particle that a widened stencil couples to another beyond its nearest neighbours.
struct DistantPair {
  Index a, b;
  friend auto operator<=>(const DistantPair&, const DistantPair&) = default;
};

bool is_neighbour(std::span<const FaceOfCell> row, Index b) {
  return std::any_of(row.begin(), row.end(), [b](const FaceOfCell& f) { return f.neighbour == b; });
}

/// All such pairs, both ways round, sorted, each once.
class DistantPairs {
 public:
  DistantPairs(const Csr<FaceOfCell>& faces, const FacePositions& positions, const Cells& cells,
               std::span<const Mat3> D)
      : faces_(faces) {
    for (std::size_t i = 0; i < cells.interior.size(); ++i) {
      if (!positions.is_widened[i]) continue;
      const InteriorFace& f = cells.interior[i];
      for (const Index a : {f.a, f.b})
        for (const Index owner : {f.a, f.b})
          for (const FaceOfCell& g : interior_faces(faces, owner)) note(a, g.neighbour);
    }
    for (const Index i : positions.widened_boundary)
      if (is_zero(D[static_cast<std::size_t>(i)]))
        for (const FaceTerm& t : positions.boundary.row(i))
          note(cells.boundary[static_cast<std::size_t>(i)].owner, t.particle);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  }

  std::span<const DistantPair> of(Index a) const {
    const auto is_before = [](const DistantPair& p, Index b) { return p.a < b; };
    const auto first = std::lower_bound(pairs_.begin(), pairs_.end(), a, is_before);
    return {first, std::lower_bound(first, pairs_.end(), a + 1, is_before)};
  }

 private:
  void note(Index a, Index b) {
    if (a == b || is_neighbour(interior_faces(faces_, a), b)) return;
    pairs_.push_back({a, b});
    pairs_.push_back({b, a});
  }

  const Csr<FaceOfCell>& faces_;
  std::vector<DistantPair> pairs_;
};

/// One bond while a row is put together.
struct BondEntry {
  Index b;
  double area;  // of the common face, zero if there is none
  Vec3 X;
  Vec3 B;
};

/// Makes the row of one particle after the other; one assembler belongs to one thread.
class RowAssembler {
 public:
  RowAssembler(std::span<const Vec3> X, const Csr<FaceOfCell>& faces, const FacePositions& positions,
               const Cells& cells, std::span<const Mat3> D, const DistantPairs& distant)
      : X_(X), faces_(faces), positions_(positions), cells_(cells), D_(D), distant_(distant) {}

  /// V_a F_a = sum_f c_f (x) A_f over the faces of a, faces with a boundary node left out. Ascending neighbours.
  std::span<const BondEntry> row(Index a) {
    start(a);
    for (const FaceOfCell& g : faces_.row(a))
      if (g.neighbour >= 0)
        add_interior(a, g);
      else if (is_zero(D_[static_cast<std::size_t>(g.face)]))
        for (const FaceTerm& t : positions_.boundary.row(g.face))
          add(a, t.particle, t.weight * cells_.boundary[static_cast<std::size_t>(g.face)].area);
    join_repeated();
    if (row_.size() > nearest_)
      std::inplace_merge(row_.begin(), row_.begin() + static_cast<std::ptrdiff_t>(nearest_), row_.end(),
                         [](const BondEntry& l, const BondEntry& r) { return l.b < r.b; });
    return row_;
  }

 private:
  const Vec3& at(Index a) const { return X_[static_cast<std::size_t>(a)]; }

  /// Neighbours with a common face first, in the order of the faces, then distant ones.
  void start(Index a) {
    row_.clear();
    of_a_ = interior_faces(faces_, a);
    for (const FaceOfCell& f : of_a_)
      row_.push_back({f.neighbour, norm(cells_.interior[static_cast<std::size_t>(f.face)].area), at(f.neighbour), {}});
    nearest_ = row_.size();
    for (const DistantPair& p : distant_.of(a)) row_.push_back({p.b, 0.0, at(p.b), {}});
  }

  /// One bond for all faces that two cells have in common.
  void join_repeated() {
    std::size_t last = 0;
    for (std::size_t i = 1; i < nearest_; ++i) {
      if (row_[i].b == row_[last].b)
        row_[last].area += row_[i].area, row_[last].B += row_[i].B;
      else if (++last != i)
        row_[last] = row_[i];
    }
    if (last + 1 >= nearest_) return;
    row_.erase(row_.begin() + static_cast<std::ptrdiff_t>(last) + 1,
               row_.begin() + static_cast<std::ptrdiff_t>(nearest_));
    nearest_ = last + 1;
  }

  void add_interior(Index a, const FaceOfCell& g) {
    const auto k = static_cast<std::size_t>(g.face);
    const InteriorFace& face = cells_.interior[k];
    const bool is_first = face.a == a;
    const Vec3 A = is_first ? face.area : -face.area;
    BondEntry& across = row_[static_cast<std::size_t>(&g - faces_.row(a).data())];
    const double s = branch_share(face);
    across.B += (is_first ? s : 1.0 - s) * A;
    const StencilFunction& w = positions_.interior[k];
    if (w.is_zero()) return;
    const Vec3 middle = on_branch(face, is_first ? at(a) : across.X, is_first ? across.X : at(a));
    const std::span<const FaceOfCell> of_b = interior_faces(faces_, g.neighbour);
    if (positions_.is_widened[k]) return add_widened(a, of_b, middle, w, A);
    across.B += w(across.X - middle) * A;
    for (const Index place : common_.find(of_a_, of_b)) {
      BondEntry& entry = row_[static_cast<std::size_t>(place)];
      entry.B += w(entry.X - middle) * A;
    }
  }

  /// Over all neighbours of both, each once.
  void add_widened(Index a, std::span<const FaceOfCell> of_b, const Vec3& middle, const StencilFunction& w,
                   const Vec3& A) {
    for (std::size_t i = 0; i < nearest_; ++i)
      if (!is_repeated(of_a_, i)) row_[i].B += w(row_[i].X - middle) * A;
    for (std::size_t i = 0; i < of_b.size(); ++i)
      if (const Index c = of_b[i].neighbour; !is_repeated(of_b, i) && !is_neighbour(of_a_, c))
        add(a, c, w(at(c) - middle) * A);
  }

  void add(Index a, Index b, const Vec3& B) {
    if (b == a) return;
    const auto nearest_end = row_.begin() + static_cast<std::ptrdiff_t>(nearest_);
    const auto is_before = [](const BondEntry& entry, Index c) { return entry.b < c; };
    auto it = std::lower_bound(row_.begin(), nearest_end, b, is_before);
    if (it == nearest_end || it->b != b) it = std::lower_bound(nearest_end, row_.end(), b, is_before);
    it->B += B;
  }

  std::span<const Vec3> X_;
  const Csr<FaceOfCell>& faces_;
  const FacePositions& positions_;
  const Cells& cells_;
  std::span<const Mat3> D_;
  const DistantPairs& distant_;

  CommonNeighbours common_;
  std::vector<BondEntry> row_;
  std::span<const FaceOfCell> of_a_;
  std::size_t nearest_ = 0;
};

/// How many bonds every row has is known before they are made, so each goes straight to its place.
void build_bonds(Discretization& d, const Cells& cells, const Csr<FaceOfCell>& faces, const FacePositions& positions,
                 std::span<const Mat3> D) {
  const DistantPairs distant(faces, positions, cells, D);
  Bonds& bonds = d.bonds;
  bonds.offset.assign(1, 0);
  bonds.offset.reserve(d.X.size() + 1);
  for (Index a = 0; a < d.particles(); ++a)
    bonds.offset.push_back(bonds.offset.back() +
                           static_cast<Offset>(count_neighbours(interior_faces(faces, a)) + distant.of(a).size()));
  const auto n = static_cast<std::size_t>(bonds.offset.back());
  bonds.neighbour.resize(n);
  bonds.B_ab.resize(n);
  bonds.area_over_length.resize(n);
  parallel::for_ranges(0, d.particles(), [&](std::int64_t begin, std::int64_t end) {
    RowAssembler assembler(d.X, faces, positions, cells, D, distant);
    for (auto a = static_cast<Index>(begin); a < static_cast<Index>(end); ++a) {
      auto k = static_cast<std::size_t>(bonds.begin(a));
      for (const BondEntry& entry : assembler.row(a)) {
        bonds.neighbour[k] = entry.b;
        bonds.B_ab[k] = entry.B;
        bonds.area_over_length[k++] = entry.area / norm(entry.X - d.X[static_cast<std::size_t>(a)]);
      }
    }
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

/// `positions` of the boundary faces: one row each.
void build_boundary(Discretization& d, const Csr<FaceTerm>& positions, const Cells& cells, std::span<const Mat3> D) {
  for (std::size_t i = 0; i < cells.boundary.size(); ++i) {
    const BoundaryFace& f = cells.boundary[i];
    const std::span<const FaceTerm> position = positions.row(static_cast<Index>(i));
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

Discretization discretize_consistent(const Generators& X, const Cells& cells, std::span<const Mat3> D,
                                     FaceOrder order) {
  Discretization d;
  describe_particles(d, X.points(), cells);
  {
    const Csr<FaceOfCell> faces = faces_of_cells(cells);
    const FacePositions positions = face_positions(X, cells, faces, D);
    build_bonds(d, cells, faces, positions, D);
    if (order == FaceOrder::quadratic) {
      d.measure = measure_of_cells(cells);
      CurvedFaces curved = curved_faces(d, cells, faces, positions, D);
      d.second_order = std::move(curved.second_order);
      build_boundary(d, curved.boundary, cells, D);
      for (BoundaryNode& node : d.nodes)
        node.spread = face_spread(cells.boundary_second_moment[static_cast<std::size_t>(node.site)], norm(node.area));
    } else {
      build_boundary(d, positions.boundary, cells, D);
    }
  }
  d.B_aa = diagonal_vectors(d);
  return d;
}

}  // namespace tessera
