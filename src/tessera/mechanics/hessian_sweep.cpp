#include "tessera/mechanics/curvature_nodes.hpp"

namespace tessera {

TESSERA_KERNEL void hessian_sweep(const System& s, Index k, const Tensor* F, CurvatureScratch& scratch,
                                  Hessian* weighted) {
  struct Node {
    Double4 v[3];  // columns of F, each with a component of the centroid
  };
  Node* __restrict nodes = reinterpret_cast<Node*>(scratch.nodes.data());
  const Vec3* C = s.d.measure->centroid.data();
  for_each_node(
      s, k, [&](Index local, Index b) { put_columns(F[b], C[b], nodes[local].v); },
      [&](Index b) { fetch(F + b), fetch(C + b); });
  RowReader rows(s, k);
  for (Index row = 0; row < rows.tile.size(); ++row, rows.next()) {
    const Node a = nodes[row];
    Double4 G[3][3]{};  // for each component of C a tensor, column by column
    rows.for_each_neighbour(
        [&](const CurvatureRows::Neighbour& n) {
          const Node& b = nodes[n.cell];
          Double4 d[3];
          unrolled<3>([&](auto j) { d[j] = b.v[j] - a.v[j]; });
          unrolled<3>([&](auto l) {
            const Double4 C_ab = fourth(d[l]);
            unrolled<3>([&](auto j) { G[l][j] += C_ab * d[j]; });
          });
        },
        rows.map);
    RowReader::fetch_result(weighted + rows.tile.begin, row);
    Double4 h[derivatives]{};
    unrolled<derivatives>([&](auto r) {
      unrolled<3>([&](auto j) { unrolled<3>([&](auto l) { h[r] += rows.map[9 * r + 3 * j + l] * G[l][j]; }); });
    });
    store_vectors(h, weighted[rows.tile.begin + row].h);
  }
}

}  // namespace tessera
