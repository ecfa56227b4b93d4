#include "tessera/mechanics/quadratic_kernel.hpp"

namespace tessera {

namespace {

/// Columns of a stress, each with a component of the position.
struct Node {
  Double4 T[3];
};

inline Columns stress_of(const Node& a) {
  return {with_fourth(a.T[0], 0.0), with_fourth(a.T[1], 0.0), with_fourth(a.T[2], 0.0)};
}

/// What a particle does to those that its derivatives follow: f_b -= T_a B_ab, and the forces of its second
/// derivatives, whose sum it feels.
struct Acting {
  const Node* nodes;
  Double4* __restrict force;
  const Columns& T;
  const QuadraticReturn& back;
  Double4 X[3];
  Double4 own{};

  Double4 of_curvature(Index b) {
    const auto way = [&](int j) { return everywhere(nodes[b].T[j][3]) - X[j]; };
    const Double4 t = back.at(way(0), way(1), way(2));
    own += t;
    return t;
  }
  void neighbour(Index b, const Vec3& B) { force[b] -= of_curvature(b) + apply(T, B); }
  void other(Index b, const Vec3& B) { force[b] -= apply(T, B); }
  void far(Index b) { force[b] -= of_curvature(b); }
};

}  // namespace

TESSERA_KERNEL void derivative_force_sweep(const System& s, Index k, const Tensor* T, const Hessian* moment,
                                           CurvatureScratch& scratch, Double4* f, Double4* rim_f) {
  Node* __restrict nodes = reinterpret_cast<Node*>(scratch.nodes.data());
  Double4* __restrict force = scratch.force.data();
  const Vec3* X = s.d.X.data();
  for_each_node(
      s, k,
      [&](Index local, Index b) {
        put_columns(T[b], X[b], nodes[local].T);
        force[local] = Double4{};
      },
      [&](Index b) { fetch(T + b), fetch(X + b); });
  RowReader rows(s, k);
  const Vec3* B_aa = s.d.B_aa.data() + rows.tile.begin;
  const Hessian* moment_own = moment + rows.tile.begin;
  for (Index row = 0; row < rows.tile.size(); ++row, rows.next()) {
    const Node& a = nodes[row];
    Double4 g[derivatives];
    put_vectors(moment_own[row], g);
    for (Index i = 0; i < rows.row->means; ++i) {
      fetch_all(moment + rows.mean[i + CurvatureRows::padding]);
      unrolled<derivatives>([&](auto r) { g[r] += vector_of<r, 3 * derivatives>(moment[rows.mean[i]].h); });
    }
    const RowReader again = rows;
    rows.for_each_neighbour(
        [&](const CurvatureRows::Neighbour& n, const Vec3&) {
          const Node& b = nodes[n.cell];
          const CurvatureRows::FaceFactors& M = rows.M[n.face];
          Double4 difference[3], t{};
          unrolled<3>([&](auto j) { difference[j] = b.T[j] - a.T[j]; });
          unrolled<3>([&](auto j) { t += fourth(difference[j]) * difference[j]; });
          unrolled<derivatives>([&](auto r) { g[r] -= M[std::size_t{r}] * t; });
        },
        reinterpret_cast<const double*>(rows.next_M), reinterpret_cast<const double*>(rows.fit),
        reinterpret_cast<const double*>(moment_own + row));
    const QuadraticReturn back(*rows.fit, g);
    const Columns T_a = stress_of(a);
    Acting acting{nodes, force, T_a, back, {fourth(a.T[0]), fourth(a.T[1]), fourth(a.T[2])}};
    for (Index i = 0; i < again.row->neighbours; ++i) {
      fetch_ahead<1536>(again.B + i);
      acting.neighbour(again.neighbour[i].cell, again.B[i]);
    }
    rows.for_each_other([&](Index b, const Vec3& B) { acting.other(b, B); });
    rows.for_each_far([&](Index b) { acting.far(b); });
    force[row] += acting.own - apply(T_a, B_aa[row]);
  }
  const Index own = rows.tile.size(), rim_size = s.tiles.rim_size(k);
  for (Index a = 0; a < own; ++a) f[rows.tile.begin + a] += with_fourth(force[a], 0.0);
  for (Index i = 0; i < rim_size; ++i) rim_f[rows.tile.rim + i] = with_fourth(force[own + i], 0.0);
}

}  // namespace tessera
