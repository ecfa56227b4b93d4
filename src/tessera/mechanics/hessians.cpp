#include "tessera/mechanics/hessians.hpp"

#include "tessera/mechanics/curvature_nodes.hpp"

namespace tessera {

CurvatureScratch::CurvatureScratch(const Tiles& tiles)
    : nodes(static_cast<std::size_t>(9 * tiles.most_nodes)), force(static_cast<std::size_t>(tiles.most_nodes)) {}

TESSERA_KERNEL void point_strain_sweep(const Symmetric3* points, const double* inverse_sum, Index begin, Index end,
                                       const Hessian* weighted, ThreeTensors* E) {
  for (Index a = begin; a < end; ++a) {
    Double4 h[derivatives];
    put_vectors(weighted[a], h);
    for (Double4& v : h) v *= inverse_sum[a];
    const Mat3 p = to_mat3(points[a]);
    for (int q = 0; q < 3; ++q)
      E[a].k[q] = {p(0, q) * h[0] + p(1, q) * h[1] + p(2, q) * h[2], p(0, q) * h[1] + p(1, q) * h[3] + p(2, q) * h[4],
                   p(0, q) * h[2] + p(1, q) * h[4] + p(2, q) * h[5]};
  }
}

TESSERA_KERNEL void point_moment_sweep(const Symmetric3* points, const double* inverse_sum, Index begin, Index end,
                                       const ThreeTensors* Z, Hessian* G) {
  for (Index a = begin; a < end; ++a) {
    const Mat3 p = to_mat3(points[a]);
    Double4 g[derivatives]{};
    for (int q = 0; q < 3; ++q) {
      const Columns& z = Z[a].k[q];
      g[0] += p(0, q) * z.c0;
      g[1] += p(0, q) * z.c1 + p(1, q) * z.c0;
      g[2] += p(0, q) * z.c2 + p(2, q) * z.c0;
      g[3] += p(1, q) * z.c1;
      g[4] += p(1, q) * z.c2 + p(2, q) * z.c1;
      g[5] += p(2, q) * z.c2;
    }
    for (Index r = 0; r < derivatives; ++r) g[r] *= inverse_sum[a];
    store_vectors(g, G[a].h);
  }
}

}  // namespace tessera
