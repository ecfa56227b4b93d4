#include "tessera/mechanics/curvature_nodes.hpp"

namespace tessera {

TESSERA_KERNEL void face_sweep(const System& s, Index k, const Hessian* weighted, CurvatureScratch& scratch, Tensor* F,
                               Hessian* sums) {
  struct Node {
    Double4 h[derivatives];  // of q H, the first three with a component of the position
  };
  Node* __restrict nodes = reinterpret_cast<Node*>(scratch.nodes.data());
  const Vec3* X = s.d.X.data();
  for_each_node(
      s, k,
      [&](Index local, Index b) {
        Double4(&h)[derivatives] = nodes[local].h;
        put_vectors(weighted[b], h);
        h[0] = with_fourth(h[0], X[b].x), h[1] = with_fourth(h[1], X[b].y), h[2] = with_fourth(h[2], X[b].z);
      },
      [&](Index b) { fetch_all(weighted + b), fetch(X + b); });
  RowReader rows(s, k);
  const double* volume = s.d.volume.data() + rows.tile.begin;
  sums += RowReader::start(s.second_order->rows, k).averaged;
  const Double4 other_way{1.0, 1.0, 1.0, -1.0};
  for (Index row = 0; row < rows.tile.size(); ++row, rows.next()) {
    Node a = nodes[row];
    if (rows.row->averaged) {
      Double4 sum[derivatives];
      unrolled<derivatives>([&](auto r) { sum[r] = a.h[r]; });
      for (Index i = 0; i < rows.row->neighbours; ++i)
        unrolled<derivatives>([&](auto r) { sum[r] += nodes[rows.neighbour[i].cell].h[r]; });
      store_vectors(sum, (sums++)->h);
    }
    Double4 VF[3]{};
    unrolled<3>([&](auto j) { a.h[j] *= other_way; });
    rows.for_each_neighbour(
        [&](const CurvatureRows::Neighbour& n, const Vec3&) {
          const Node& b = nodes[n.cell];
          const CurvatureRows::FaceFactors& M = rows.M[n.face];
          Double4 both[derivatives], part[2]{};  // two sums, each of which waits for fewer others
          unrolled<derivatives>([&](auto r) {
            both[r] = a.h[r] + b.h[r];
            part[r % 2] += M[std::size_t{r}] * both[r];
          });
          const Double4 c = part[0] + part[1];
          unrolled<3>([&](auto j) { VF[j] += fourth(both[j]) * c; });
        },
        reinterpret_cast<const double*>(rows.next_M));
    RowReader::fetch_result(F + rows.tile.begin, row);
    Tensor& F_a = F[rows.tile.begin + row];
    const Columns change{VF[0], VF[1], VF[2]};
    store(F_a, to_kernel(F_a) + (1.0 / volume[row]) * change);
  }
}

}  // namespace tessera
