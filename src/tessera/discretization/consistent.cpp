#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tessera/base/error.hpp"
#include "tessera/discretization/rows.hpp"
#include "tessera/discretization/stencil.hpp"
#include "tessera/discretization/voronoi.hpp"
#include "tessera/discretization/voronoi_common.hpp"

namespace tessera {

namespace {

// A stencil that needs weights this many times larger than the face's offset is as good as degenerate.
constexpr double largest_amplification = 10.0;
// What a face position may miss, relative to the distance of the particles.
constexpr double position_tolerance = 1e-12;
// Faces whose centroid is this close to the middle of the branch, relative to its length, need no stencil.
constexpr double centred = 1e-15;

/// One face's position c_f = sum_k weight_k x_k.
struct Term {
  Index particle;
  double weight;
};
using Position = std::vector<Term>;

class ConsistentFaces {
 public:
  ConsistentFaces(std::span<const Vec3> X, const Cells& cells) : X_(X), cells_(cells), faces_(faces_of_cells(cells)) {}

  Position interior(const InteriorFace& f) const;
  Position boundary(const BoundaryFace& f, const Mat3& D) const;
  const Csr<FaceOfCell>& faces() const { return faces_; }

 private:
  std::vector<Index> neighbours(Index a) const;
  Position around(const InteriorFace& f, const std::vector<Index>& stencil, const StencilWeights& weights) const;
  const Vec3& at(Index a) const { return X_[static_cast<std::size_t>(a)]; }

  std::span<const Vec3> X_;
  const Cells& cells_;
  Csr<FaceOfCell> faces_;
};

std::vector<Index> ConsistentFaces::neighbours(Index a) const {
  std::vector<Index> list;
  for (const FaceOfCell& f : faces_.row(a))
    if (f.neighbour >= 0) list.push_back(f.neighbour);
  return list;
}

std::vector<Index> united(const std::vector<Index>& l, const std::vector<Index>& r) {
  std::vector<Index> both;
  std::set_union(l.begin(), l.end(), r.begin(), r.end(), std::back_inserter(both));
  return both;
}

std::vector<Index> common(const std::vector<Index>& l, const std::vector<Index>& r) {
  std::vector<Index> both;
  std::set_intersection(l.begin(), l.end(), r.begin(), r.end(), std::back_inserter(both));
  return both;
}

std::vector<Vec3> relative(std::span<const Vec3> X, const std::vector<Index>& stencil, const Vec3& origin) {
  std::vector<Vec3> y;
  y.reserve(stencil.size());
  for (Index c : stencil) y.push_back(X[static_cast<std::size_t>(c)] - origin);
  return y;
}

Position ConsistentFaces::around(const InteriorFace& f, const std::vector<Index>& stencil,
                                 const StencilWeights& weights) const {
  Position position{{f.a, 0.5}, {f.b, 0.5}};
  for (std::size_t c = 0; c < stencil.size(); ++c) position.push_back({stencil[c], weights.w[c]});
  return position;
}

/// c_f = (x_a + x_b)/2 + sum_c w_c x_c: over a, b and their common neighbours; over all neighbours of both where
/// those do not span the face's offset.
Position ConsistentFaces::interior(const InteriorFace& f) const {
  const Vec3 middle = 0.5 * (at(f.a) + at(f.b));
  const Vec3 offset = f.centroid - middle;
  const double L = norm(at(f.b) - at(f.a));
  if (norm(offset) <= centred * L) return {{f.a, 0.5}, {f.b, 0.5}};

  const std::vector<Index> of_a = neighbours(f.a), of_b = neighbours(f.b);
  const std::vector<Index> pair{f.a, f.b};
  for (const std::vector<Index>& stencil : {united(common(of_a, of_b), pair), united(united(of_a, of_b), pair)}) {
    const std::vector<Vec3> y = relative(X_, stencil, middle);
    const StencilWeights weights = balanced_weights(y, offset);
    if (norm(weights.residual) <= position_tolerance * L && weights.amplification <= largest_amplification)
      return around(f, stencil, weights);
  }
  throw GeometryError(
      fmt::format("the face between particles {} at ({:g}, {:g}, {:g}) and {} at ({:g}, {:g}, {:g}) cannot follow a "
                  "linear motion: their "
                  "neighbours lie in one plane or line; use at least two layers of particles in every direction",
                  f.a, at(f.a).x, at(f.a).y, at(f.a).z, f.b, at(f.b).x, at(f.b).y, at(f.b).z));
}

/// The free components of c_f = x_a + sum_c w_c (x_c - x_a): over the neighbours, over theirs too where those do not
/// span the way from the particle to the face. What a symmetric face moves along its normal is prescribed, so
/// its residual may point there (a slab one cell thick).
Position ConsistentFaces::boundary(const BoundaryFace& f, const Mat3& D) const {
  const Vec3 offset = f.centroid - at(f.owner), N = normalized(f.area);
  const double size = std::cbrt(cells_.volume[static_cast<std::size_t>(f.owner)]);
  const Mat3 along_normal = D - outer(N, N);
  const bool symmetric = contract(along_normal, along_normal) < 1e-20;

  const std::vector<Index> first = neighbours(f.owner);
  std::vector<Index> second = first;
  for (Index c : first) second = united(second, neighbours(c));
  std::erase(second, f.owner);
  for (const std::vector<Index>& stencil : {first, second}) {
    if (stencil.empty()) continue;
    const StencilWeights weights = spanning_weights(relative(X_, stencil, at(f.owner)), offset);
    const Vec3 missed = symmetric ? weights.residual - dot(weights.residual, N) * N : weights.residual;
    if (norm(missed) > position_tolerance * size || weights.amplification > largest_amplification) continue;
    Position position;
    double sum = 0.0;
    for (std::size_t c = 0; c < stencil.size(); ++c) {
      position.push_back({stencil[c], weights.w[c]});
      sum += weights.w[c];
    }
    position.push_back({f.owner, 1.0 - sum});
    return position;
  }
  throw GeometryError(
      fmt::format("the boundary face of particle {} at ({:g}, {:g}, {:g}) cannot follow a linear motion: the "
                  "particle's neighbours lie in "
                  "one plane or line; use at least two layers of particles in every direction",
                  f.owner, at(f.owner).x, at(f.owner).y, at(f.owner).z));
}

/// Positions of all faces; empty for boundary faces that are wholly prescribed.
struct Positions {
  std::vector<Position> interior;
  std::vector<Position> boundary;
};

Positions face_positions(const ConsistentFaces& faces, const Cells& cells, std::span<const Mat3> D) {
  Positions p;
  p.interior.reserve(cells.interior.size());
  for (const InteriorFace& f : cells.interior) p.interior.push_back(faces.interior(f));
  p.boundary.resize(cells.boundary.size());
  for (std::size_t i = 0; i < cells.boundary.size(); ++i)
    if (!is_identity(D[i])) p.boundary[i] = faces.boundary(cells.boundary[i], D[i]);
  return p;
}

/// Pairs beyond the nearest neighbours that widened stencils couple, both ways round.
Csr<Index> distant_pairs(const Csr<FaceOfCell>& faces, const Positions& positions, const Cells& cells,
                         std::span<const Mat3> D) {
  struct Pair {
    Index a, b;
  };
  std::vector<Pair> pairs;
  const auto note = [&](Index a, const Position& position) {
    const auto row = faces.row(a);
    for (const Term& t : position) {
      const bool near = t.particle == a || std::any_of(row.begin(), row.end(),
                                                       [&](const FaceOfCell& f) { return f.neighbour == t.particle; });
      if (!near) pairs.push_back({a, t.particle}), pairs.push_back({t.particle, a});
    }
  };
  for (std::size_t i = 0; i < cells.interior.size(); ++i) {
    note(cells.interior[i].a, positions.interior[i]);
    note(cells.interior[i].b, positions.interior[i]);
  }
  for (std::size_t i = 0; i < cells.boundary.size(); ++i)
    if (is_zero(D[i])) note(cells.boundary[i].owner, positions.boundary[i]);
  const Csr<Pair> rows =
      group_by_row<Pair>(static_cast<Index>(cells.volume.size()), pairs, [](const Pair& p) { return p.a; });
  Csr<Index> distant;
  distant.offset = rows.offset;
  for (const Pair& p : rows.value) distant.value.push_back(p.b);
  return distant;
}

/// V_a F_a = sum_f c_f (x) A_f over the faces of a, faces with a boundary node left out.
void collect_row(RowBuffer& row, Index a, const Csr<FaceOfCell>& faces, const Positions& positions, const Cells& cells,
                 std::span<const Mat3> D) {
  for (const FaceOfCell& g : faces.row(a)) {
    const auto k = static_cast<std::size_t>(g.face);
    if (g.neighbour >= 0) {
      const InteriorFace& f = cells.interior[k];
      const Vec3 A = f.a == a ? f.area : -f.area;
      row.add(g.neighbour, Vec3{});
      for (const Term& t : positions.interior[k]) row.add(t.particle, t.weight * A);
    } else if (is_zero(D[k])) {
      for (const Term& t : positions.boundary[k]) row.add(t.particle, t.weight * cells.boundary[k].area);
    }
  }
}

void build_bonds(Discretization& d, const Csr<FaceOfCell>& faces, const Positions& positions, const Cells& cells,
                 std::span<const Mat3> D) {
  const Csr<Index> distant = distant_pairs(faces, positions, cells, D);
  RowBuffer row;
  for (Index a = 0; a < d.particles(); ++a) {
    collect_row(row, a, faces, positions, cells, D);
    for (Index b : distant.row(a)) row.add(b, Vec3{});
    row.drain([&](Index b, const Vec3& B) {
      if (b == a) return;
      d.bonds.neighbour.push_back(b);
      d.bonds.B_ab.push_back(B);
    });
    d.bonds.offset.push_back(static_cast<Offset>(d.bonds.neighbour.size()));
  }
  complete_bonds(d.bonds, d.X);
  d.bonds.area_over_length.assign(d.bonds.neighbour.size(), 0.0);
  for (const InteriorFace& f : cells.interior) {
    const auto ab = static_cast<std::size_t>(d.bonds.find(f.a, f.b)),
               ba = static_cast<std::size_t>(d.bonds.find(f.b, f.a));
    d.bonds.area_over_length[ab] = d.bonds.area_over_length[ba] = norm(f.area) / norm(d.bonds.X_ab[ab]);
  }
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

void build_boundary(Discretization& d, const Positions& positions, const Cells& cells, std::span<const Mat3> D) {
  for (std::size_t i = 0; i < cells.boundary.size(); ++i) {
    const BoundaryFace& f = cells.boundary[i];
    std::vector<LoadShare> shares;
    for (const Term& t : positions.boundary[i]) shares.push_back({t.particle, t.weight * norm(f.area)});
    d.load.value.insert(d.load.value.end(), shares.begin(), shares.end());
    d.load.offset.push_back(static_cast<Offset>(d.load.value.size()));
    if (is_zero(D[i])) continue;
    const auto owner = static_cast<std::size_t>(f.owner);
    d.nodes.push_back(constrained_node(f, static_cast<Index>(i), D[i], d.X[owner], d.volume[owner]));
    for (const Term& t : positions.boundary[i]) d.closure.value.push_back({t.particle, 0.0, t.weight});
    d.closure.offset.push_back(static_cast<Offset>(d.closure.value.size()));
  }
}

}  // namespace

Discretization discretize_consistent(std::span<const Vec3> X, const Cells& cells, std::span<const Mat3> D) {
  Discretization d;
  describe_particles(d, X, cells);
  const ConsistentFaces faces(X, cells);
  const Positions positions = face_positions(faces, cells, D);
  build_bonds(d, faces.faces(), positions, cells, D);
  build_boundary(d, positions, cells, D);
  d.B_aa = diagonal_vectors(d);
  return d;
}

}  // namespace tessera
