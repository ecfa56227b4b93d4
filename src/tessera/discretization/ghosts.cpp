#include "tessera/discretization/ghosts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/error.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/discretization/voronoi_common.hpp"

namespace tessera {

Eigen::MatrixXd branch_expansion(std::span<const GhostNeighbour> neighbours, double V_a) {
  const auto n = static_cast<Eigen::Index>(neighbours.size());
  Eigen::MatrixXd H(n, n);
  for (Eigen::Index c = 0; c < n; ++c)
    for (Eigen::Index d = 0; d < n; ++d)
      H(c, d) = dot(neighbours[static_cast<std::size_t>(c)].X_ab, neighbours[static_cast<std::size_t>(d)].B_ab) / V_a;
  return H;
}

Eigen::MatrixXd least_squares_matrix(const Eigen::MatrixXd& H) {
  return Eigen::MatrixXd::Identity(H.rows(), H.cols()) - H - H.transpose() + H.transpose() * H;
}

Eigen::MatrixXd ghost_coefficients(const Eigen::MatrixXd& K, std::span<const int> free) {
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd K_free(n, n), K_rows(n, K.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int b = free[static_cast<std::size_t>(i)];
    K_rows.row(i) = K.row(b);
    for (Eigen::Index j = 0; j < n; ++j) K_free(i, j) = K(b, free[static_cast<std::size_t>(j)]);
  }
  for (int b : free) K_rows.col(b).setZero();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(n, n);
  decomposition.setThreshold(1e-10);
  decomposition.compute(K_free);
  return -decomposition.solve(K_rows);
}

namespace {

// A ghost closer than this, relative to the cell's size, makes the gradient vector [V 7] meaningless.
constexpr double smallest_distance = 1e-3;

/// A boundary particle with all its neighbours, and the coefficients of its free ghosts.
class GhostParticle {
 public:
  GhostParticle(Index a, const Generators& X, const Cells& cells, const Csr<FaceOfCell>& faces,
                std::span<const Mat3> D);

  Index ghosts() const { return static_cast<Index>(neighbours_.size()) - real_; }
  Index real() const { return real_; }
  /// Number of the boundary face, the neighbour and the coefficients K' of ghost g.
  Index face(Index g) const { return faces_[static_cast<std::size_t>(real_ + g)].face; }
  Index particle(Index c) const { return faces_[static_cast<std::size_t>(c)].neighbour; }
  const GhostNeighbour& real_neighbour(Index c) const { return neighbours_[static_cast<std::size_t>(c)]; }
  const GhostNeighbour& ghost(Index g) const { return neighbours_[static_cast<std::size_t>(real_ + g)]; }
  bool prescribed(Index g) const { return row_[static_cast<std::size_t>(g)] < 0; }
  double coefficient(Index g, Index c) const { return K_(row_[static_cast<std::size_t>(g)], c); }

 private:
  std::span<const FaceOfCell> faces_;
  std::vector<GhostNeighbour> neighbours_;
  Index real_ = 0;
  std::vector<int> row_;  // row of K' of each ghost; -1: fully prescribed
  Eigen::MatrixXd K_;
};

GhostNeighbour real_neighbour(const InteriorFace& f, Index a, const Generators& X) {
  const Index b = f.a == a ? f.b : f.a;
  const Vec3& X_a = X[static_cast<std::size_t>(a)];
  const Vec3 X_ab = X[static_cast<std::size_t>(b)] - X_a;
  return {X_ab, (norm(f.area) / norm(X_ab)) * (f.centroid - X_a)};  // [V 7]
}

GhostNeighbour mirror_image(const BoundaryFace& f, const Generators& X, double size) {
  const Vec3& X_a = X[static_cast<std::size_t>(f.owner)];
  const Vec3 N = normalized(f.area);
  const double distance = dot(N, f.centroid - X_a);
  if (std::abs(distance) < smallest_distance * size)
    throw GeometryError(
        fmt::format("particle {} lies in the plane of one of its boundary faces, so it has no ghost there; move the "
                    "particle or use boundary = \"consistent\"",
                    X.named(f.owner)));
  // A negative distance (at a re-entrant edge) gives a ghost on the other side; the algebra of [V 6, 7] holds with L =
  // 2 d.
  return {2.0 * distance * N, (norm(f.area) / (2.0 * distance)) * (f.centroid - X_a)};
}

GhostParticle::GhostParticle(Index a, const Generators& X, const Cells& cells, const Csr<FaceOfCell>& faces,
                             std::span<const Mat3> D)
    : faces_(faces.row(a)) {
  const double V_a = cells.volume[static_cast<std::size_t>(a)];
  std::vector<int> free;
  for (const FaceOfCell& f : faces_) {
    const auto k = static_cast<std::size_t>(f.face);
    if (f.neighbour >= 0) {
      neighbours_.push_back(tessera::real_neighbour(cells.interior[k], a, X));
      ++real_;
      continue;
    }
    row_.push_back(is_identity(D[k]) ? -1 : static_cast<int>(free.size()));
    if (row_.back() >= 0) free.push_back(static_cast<int>(neighbours_.size()));
    neighbours_.push_back(mirror_image(cells.boundary[k], X, std::cbrt(V_a)));
  }
  if (!free.empty()) K_ = ghost_coefficients(least_squares_matrix(branch_expansion(neighbours_, V_a)), free);
}

/// Turns ghosts into bonds (free ghosts: static condensation [V 27, 28]), nodes and closure rows.
class GhostDiscretization {
 public:
  GhostDiscretization(const Generators& X, const Cells& cells, std::span<const Mat3> D)
      : X_(X), cells_(cells), D_(D), faces_(faces_of_cells(cells)) {
    describe_particles(d_, X.points(), cells);
  }

  Discretization build(GhostForce force) {
    RowBuffer row;
    for (Index a = 0; a < d_.particles(); ++a) {
      if (faces_.row(a).empty() || faces_.row(a).back().neighbour >= 0)
        add_interior(row, a);
      else
        add_boundary(row, GhostParticle(a, X_, cells_, faces_, D_), a);
      finish_row(row, a);
    }
    add_stiffness();
    add_loads();
    d_.B_aa = diagonal_vectors(d_);
    d_.boundary_force = BoundaryForce::direct;
    if (force == GhostForce::quasi_static) add_direct_force();
    return std::move(d_);
  }

 private:
  void add_interior(RowBuffer& row, Index a) const {
    for (const FaceOfCell& f : faces_.row(a))
      row.add(f.neighbour, real_neighbour(cells_.interior[static_cast<std::size_t>(f.face)], a, X_).B_ab);
  }
  void add_boundary(RowBuffer& row, const GhostParticle& p, Index a);
  void add_node(const GhostParticle& p, Index a, Index g, const std::vector<Index>& node_of);
  void finish_row(RowBuffer& row, Index a);
  void add_stiffness();
  void add_loads();
  void add_direct_force();

  Generators X_;
  const Cells& cells_;
  std::span<const Mat3> D_;
  Csr<FaceOfCell> faces_;
  Discretization d_;
};

void GhostDiscretization::finish_row(RowBuffer& row, Index a) {
  row.drain([&](Index b, const Vec3& B) {
    if (b == a) return;
    d_.bonds.neighbour.push_back(b);
    d_.bonds.B_ab.push_back(B);
  });
  d_.bonds.offset.push_back(static_cast<Offset>(d_.bonds.neighbour.size()));
}

void GhostDiscretization::add_boundary(RowBuffer& row, const GhostParticle& p, Index a) {
  for (Index c = 0; c < p.real(); ++c) row.add(p.particle(c), p.real_neighbour(c).B_ab);

  // Nodes of the constrained ghosts, fully prescribed ones first because the others may follow them.
  std::vector<Index> node_of(static_cast<std::size_t>(p.ghosts()), -1);
  for (const bool prescribed : {true, false})
    for (Index g = 0; g < p.ghosts(); ++g) {
      if (p.prescribed(g) != prescribed || is_zero(D_[static_cast<std::size_t>(p.face(g))])) continue;
      node_of[static_cast<std::size_t>(g)] = static_cast<Index>(d_.nodes.size());
      add_node(p, a, g, node_of);
    }

  for (Index g = 0; g < p.ghosts(); ++g) {
    if (!is_zero(D_[static_cast<std::size_t>(p.face(g))])) continue;
    for (Index c = 0; c < p.real(); ++c) row.add(p.particle(c), p.coefficient(g, c) * p.ghost(g).B_ab);
    for (Index e = 0; e < p.ghosts(); ++e)
      if (p.prescribed(e))
        d_.nodes[static_cast<std::size_t>(node_of[static_cast<std::size_t>(e)])].B_af +=
            p.coefficient(g, p.real() + e) * p.ghost(g).B_ab;
  }
}

/// x_g = x_a + D xbar_ag + (I - D) sum_c K'_gc x_ac with xbar_ag = 2 (W_g + ubar_g - x_a), [V 24].
void GhostDiscretization::add_node(const GhostParticle& p, Index a, Index g, const std::vector<Index>& node_of) {
  const auto site = static_cast<std::size_t>(p.face(g));
  const BoundaryFace& f = cells_.boundary[site];
  const Vec3& X_a = X_[static_cast<std::size_t>(a)];
  BoundaryNode node;
  node.owner = a;
  node.site = p.face(g);
  node.N = normalized(f.area);
  node.X = X_a + p.ghost(g).X_ab;
  node.wall = X_a + 0.5 * p.ghost(g).X_ab;
  node.area = f.area;
  node.D = D_[site];
  node.wall_share = 2.0;
  node.B_af = p.ghost(g).B_ab;
  node.area_over_length = norm(f.area) / norm(p.ghost(g).X_ab);
  d_.nodes.push_back(node);

  double sum = 0.0;
  if (!p.prescribed(g)) {
    for (Index c = 0; c < p.real(); ++c) {
      d_.closure.value.push_back({p.particle(c), 0.0, p.coefficient(g, c)});
      sum += p.coefficient(g, c);
    }
    for (Index e = 0; e < p.ghosts(); ++e)
      if (p.prescribed(e)) {
        d_.closure.value.push_back(
            {d_.particles() + node_of[static_cast<std::size_t>(e)], 0.0, p.coefficient(g, p.real() + e)});
        sum += p.coefficient(g, p.real() + e);
      }
  }
  d_.closure.value.push_back({a, 1.0 - node.wall_share, 1.0 - sum});
  d_.closure.offset.push_back(static_cast<Offset>(d_.closure.value.size()));
}

void GhostDiscretization::add_stiffness() {
  d_.bonds.area_over_length.assign(d_.bonds.neighbour.size(), 0.0);
  for (const InteriorFace& f : cells_.interior) {
    const auto ab = static_cast<std::size_t>(d_.bonds.find(f.a, f.b));
    const auto ba = static_cast<std::size_t>(d_.bonds.find(f.b, f.a));
    d_.bonds.area_over_length[ab] = d_.bonds.area_over_length[ba] =
        norm(f.area) / norm(d_.branch(f.a, static_cast<Offset>(ab)));
  }
}

/// Tractions act on the particle itself, [V 35].
void GhostDiscretization::add_loads() {
  for (const BoundaryFace& f : cells_.boundary) {
    d_.load.value.push_back({f.owner, norm(f.area)});
    d_.load.offset.push_back(static_cast<Offset>(d_.load.value.size()));
  }
}

/// f_a = sum_b (P_a B_ab - P_b B_ba) over real neighbours with the bare gradient vectors, [V 42].
void GhostDiscretization::add_direct_force() {
  DirectForce direct;
  direct.B_ba.resize(d_.bonds.neighbour.size());
  direct.B_aa.resize(d_.X.size());
  for (const InteriorFace& f : cells_.interior) {
    const Vec3 B_ab = real_neighbour(f, f.a, X_).B_ab, B_ba = real_neighbour(f, f.b, X_).B_ab;
    direct.B_ba[static_cast<std::size_t>(d_.bonds.find(f.a, f.b))] = B_ba;
    direct.B_ba[static_cast<std::size_t>(d_.bonds.find(f.b, f.a))] = B_ab;
    direct.B_aa[static_cast<std::size_t>(f.a)] -= B_ab;
    direct.B_aa[static_cast<std::size_t>(f.b)] -= B_ba;
  }
  d_.direct = std::move(direct);
}

}  // namespace

Discretization discretize_ghosts(const Generators& X, const Cells& cells, std::span<const Mat3> D, GhostForce force) {
  return GhostDiscretization(X, cells, D).build(force);
}

}  // namespace tessera
