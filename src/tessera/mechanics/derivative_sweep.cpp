#include "tessera/mechanics/quadratic_kernel.hpp"

namespace tessera {

TESSERA_KERNEL void derivative_sweep(const System& s, Index k, const Double4* x, CurvatureScratch& scratch, Tensor* F,
                                     Hessian* weighted) {
  struct Node {
    Double4 x, X;
  };
  Node* __restrict nodes = reinterpret_cast<Node*>(scratch.nodes.data());
  const Vec3* X = s.d.X.data();
  for_each_node(
      s, k,
      [&](Index local, Index b) {
        nodes[local] = {x[b], vector_at(X[b])};
      },
      [&](Index b) { fetch(x + b), fetch(X + b); });
  RowReader rows(s, k);
  const double* volume = s.d.volume.data() + rows.tile.begin;
  for (Index row = 0; row < rows.tile.size(); ++row, rows.next()) {
    const Node a = nodes[row];
    QuadraticMoments moments;
    Columns VF{};
    rows.for_each_neighbour(
        [&](const CurvatureRows::Neighbour& n, const Vec3& B) {
          fetch_ahead<1536>(&B);
          const Double4 u = nodes[n.cell].x - a.x;
          moments.add(nodes[n.cell].X - a.X, u);
          add_outer(VF, u, B);
        },
        reinterpret_cast<const double*>(rows.fit));
    rows.for_each_other([&](Index b, const Vec3& B) { add_outer(VF, nodes[b].x - a.x, B); });
    rows.for_each_far([&](Index b) { moments.add(nodes[b].X - a.X, nodes[b].x - a.x); });
    RowReader::fetch_result(weighted + rows.tile.begin, row);
    RowReader::fetch_result(F + rows.tile.begin, row);
    store(F[rows.tile.begin + row], (1.0 / volume[row]) * VF);
    Double4 h[derivatives];
    fitted(*rows.fit, moments, h);
    store_vectors(h, weighted[rows.tile.begin + row].h);
  }
}

}  // namespace tessera
