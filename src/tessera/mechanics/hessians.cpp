#include "tessera/mechanics/hessians.hpp"

#include <algorithm>

#include "tessera/mechanics/tile_nodes.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

std::array<double, 6> components(const Symmetric3& s) { return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz}; }

Csr<Index> transposed_pattern(const Csr<Index>& rows) {
  Csr<Index> t;
  t.offset.assign(rows.offset.size(), 0);
  for (const Index b : rows.value) ++t.offset[static_cast<std::size_t>(b) + 1];
  for (std::size_t b = 1; b < t.offset.size(); ++b) t.offset[b] += t.offset[b - 1];
  std::vector<Offset> next(t.offset.begin(), t.offset.end() - 1);
  t.value.resize(rows.value.size());
  for (Index a = 0; a < rows.rows(); ++a)
    for (const Index b : rows.row(a)) t.value[static_cast<std::size_t>(next[static_cast<std::size_t>(b)]++)] = a;
  return t;
}

}  // namespace

HessianRows hessian_rows(const Discretization& d) {
  const SecondOrder& s = *d.second_order;
  HessianRows rows;
  for (const Vec3& X : d.X) rows.X.push_back(to_kernel(X));
  rows.stencil = s.fits.stencil;
  rows.reached_from = transposed_pattern(rows.stencil);
  rows.fit = s.fits.fit;
  rows.own.resize(d.X.size());
  rows.first_face = s.faces.offset;
  rows.faces.resize(s.faces.value.size());
  rows.surfaces = s.surfaces;
  parallel::for_each(d.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    Symmetric3 sum;
    for (const Index b : rows.stencil.row(static_cast<Index>(i)))
      sum -= rows.fit[a].weights(d.X[static_cast<std::size_t>(b)] - d.X[a]);
    rows.own[a] = components(sum);
    for (auto k = static_cast<std::size_t>(rows.first_face[a]); k < static_cast<std::size_t>(rows.first_face[a + 1]);
         ++k) {
      const CurvedFace& f = s.faces.value[k];
      const Symmetric3 half = 0.5 * f.M;
      rows.faces[k] = {f.neighbour,
                       {f.area.x, f.area.y, f.area.z},
                       {half.xx, 2.0 * half.xy, 2.0 * half.xz, half.yy, 2.0 * half.yz, half.zz}};
    }
  });
  return rows;
}

namespace {

/// The sum of the four vectors, with a zero at the end.
inline Double4 total(const Lanes3& l) {
  const Double4 zero{};
  const Double4 xy = __builtin_shuffle(l.x, l.y, Mask4{0, 4, 2, 6}) + __builtin_shuffle(l.x, l.y, Mask4{1, 5, 3, 7});
  const Double4 z0 = __builtin_shuffle(l.z, zero, Mask4{0, 4, 2, 6}) + __builtin_shuffle(l.z, zero, Mask4{1, 5, 3, 7});
  return __builtin_shuffle(xy, z0, Mask4{0, 1, 4, 5}) + __builtin_shuffle(xy, z0, Mask4{2, 3, 6, 7});
}

}  // namespace

TESSERA_KERNEL void hessian_sweep(const HessianRows& rows, Index begin, Index end, const Double4* x, Hessian* H) {
  constexpr std::array<Double4, 4> part{Double4{1, 0, 0, 0}, Double4{1, 1, 0, 0}, Double4{1, 1, 1, 0},
                                        Double4{1, 1, 1, 1}};
  const Double4* X = rows.X.data();
  for (Index a = begin; a < end; ++a) {
    const Double4 X_a = X[a], x_a = x[a];
    const Index* b = rows.stencil.value.data() + rows.stencil.begin(a);
    const auto n = static_cast<Index>(rows.stencil.end(a) - rows.stencil.begin(a));
    std::array<Lanes3, 9> moments{};
    for (Index i = 0; i < n; i += 4) {
      const Index last = std::min<Index>(3, n - 1 - i);
      const Index b0 = b[i], b1 = b[i + std::min<Index>(1, last)], b2 = b[i + std::min<Index>(2, last)],
                  b3 = b[i + last];
      const Lanes3 y = transposed(X[b0] - X_a, X[b1] - X_a, X[b2] - X_a, X[b3] - X_a);
      const Lanes3 u = transposed(x[b0] - x_a, x[b1] - x_a, x[b2] - x_a, x[b3] - x_a);
      const Double4 w = part[static_cast<std::size_t>(last)] / (y.x * y.x + y.y * y.y + y.z * y.z);
      const Double4 wx = w * y.x, wy = w * y.y, wz = w * y.z;
      const auto add = [&u](Lanes3& m, const Double4& q) {
        m.x += q * u.x;
        m.y += q * u.y;
        m.z += q * u.z;
      };
      add(moments[0], wx);
      add(moments[1], wy);
      add(moments[2], wz);
      add(moments[3], wx * y.x);
      add(moments[4], wx * y.y);
      add(moments[5], wx * y.z);
      add(moments[6], wy * y.y);
      add(moments[7], wy * y.z);
      add(moments[8], wz * y.z);
    }
    Hessian result;
    for (std::size_t c = 0; c < 9; ++c) {
      const Double4 m = total(moments[c]);
      for (std::size_t r = 0; r < 6; ++r) result.h[r] += rows.fit[static_cast<std::size_t>(a)].S[r][c] * m;
    }
    H[a] = result;
  }
}

namespace {

/// Calls body(surface) for the surfaces of particles in [begin, end).
template <class Body>
void for_each_surface(const HessianRows& rows, Index begin, Index end, Body&& body) {
  auto it = std::lower_bound(rows.surfaces.begin(), rows.surfaces.end(), begin,
                             [](const CurvedSurface& s, Index a) { return s.particle < a; });
  for (; it != rows.surfaces.end() && it->particle < end; ++it) body(*it);
}

}  // namespace

TESSERA_KERNEL void curvature_strain_sweep(const HessianRows& rows, const double* volume, Index begin, Index end,
                                           const Hessian* H, Tensor* F) {
  const HessianRows::Face* f = rows.faces.data() + rows.first_face[static_cast<std::size_t>(begin)];
  for (Index a = begin; a < end; ++a) {
    const Hessian own = H[a];
    Columns VF{};
    for (const auto* last = rows.faces.data() + rows.first_face[static_cast<std::size_t>(a) + 1]; f != last; ++f) {
      const Hessian& across = H[f->neighbour];
      Double4 c{};
      for (std::size_t r = 0; r < 6; ++r) c += f->m[r] * (own.h[r] + across.h[r]);
      VF.c0 += c * f->area[0];
      VF.c1 += c * f->area[1];
      VF.c2 += c * f->area[2];
    }
    F[a] = to_tensor(to_kernel(F[a]) + (1.0 / volume[a]) * VF);
  }
  for_each_surface(rows, begin, end, [&](const CurvedSurface& s) {
    Columns VF{};
    for (std::size_t r = 0; r < 6; ++r) add_outer(VF, H[s.particle].h[r], s.area_moment[r]);
    F[s.particle] = to_tensor(to_kernel(F[s.particle]) + (1.0 / volume[s.particle]) * VF);
  });
}

TESSERA_KERNEL void point_strain_sweep(const Mat3* points, Index begin, Index end, const Hessian* H, ThreeTensors* E) {
  for (Index a = begin; a < end; ++a) {
    const std::array<Double4, 6>& h = H[a].h;
    const Mat3& p = points[a];
    for (int q = 0; q < 3; ++q)
      E[a].k[q] = {p(0, q) * h[0] + p(1, q) * h[1] + p(2, q) * h[2], p(0, q) * h[1] + p(1, q) * h[3] + p(2, q) * h[4],
                   p(0, q) * h[2] + p(1, q) * h[4] + p(2, q) * h[5]};
  }
}

TESSERA_KERNEL void point_moment_sweep(const Mat3* points, Index begin, Index end, const ThreeTensors* Z, Hessian* G) {
  for (Index a = begin; a < end; ++a) {
    const Mat3& p = points[a];
    std::array<Double4, 6> g{};
    for (int q = 0; q < 3; ++q) {
      const Columns& z = Z[a].k[q];
      g[0] += p(0, q) * z.c0;
      g[1] += p(0, q) * z.c1 + p(1, q) * z.c0;
      g[2] += p(0, q) * z.c2 + p(2, q) * z.c0;
      g[3] += p(1, q) * z.c1;
      g[4] += p(1, q) * z.c2 + p(2, q) * z.c1;
      g[5] += p(2, q) * z.c2;
    }
    G[a].h = g;
  }
}

TESSERA_KERNEL void curvature_moment_sweep(const HessianRows& rows, Index begin, Index end, const Tensor* T, Hessian* G,
                                           FitMoment* g) {
  for_each_surface(rows, begin, end, [&](const CurvedSurface& s) {
    for (std::size_t r = 0; r < 6; ++r) G[s.particle].h[r] += apply(to_kernel(T[s.particle]), s.area_moment[r]);
  });
  const HessianRows::Face* f = rows.faces.data() + rows.first_face[static_cast<std::size_t>(begin)];
  for (Index a = begin; a < end; ++a) {
    const Columns own = to_kernel(T[a]);
    Hessian moment = G[a];
    for (const auto* last = rows.faces.data() + rows.first_face[static_cast<std::size_t>(a) + 1]; f != last; ++f) {
      const Columns across = to_kernel(T[f->neighbour]);
      const Double4 t =
          (own.c0 - across.c0) * f->area[0] + (own.c1 - across.c1) * f->area[1] + (own.c2 - across.c2) * f->area[2];
      for (std::size_t r = 0; r < 6; ++r) moment.h[r] += f->m[r] * t;
    }
    G[a] = moment;
    FitMoment result{};
    const QuadraticFit& fit = rows.fit[static_cast<std::size_t>(a)];
    for (std::size_t r = 0; r < 6; ++r)
      for (std::size_t c = 0; c < 9; ++c) result.g[c] += fit.S[r][c] * moment.h[r];
    g[a] = result;
  }
}

TESSERA_KERNEL void hessian_force_sweep(const HessianRows& rows, Index begin, Index end, const Hessian* G,
                                        const FitMoment* g, Double4* f) {
  const Double4* X = rows.X.data();
  for (Index a = begin; a < end; ++a) {
    Double4 sum{};
    for (const Index b : rows.reached_from.row(a)) {
      const Double4 y = X[a] - X[b];
      const Double4 square = y * y;
      const double w = 1.0 / (square[0] + square[1] + square[2]);
      const std::array<Double4, 9>& q = g[b].g;
      const Double4 first = q[0] + y[0] * q[3] + y[1] * q[4] + y[2] * q[5];
      const Double4 second = q[1] + y[1] * q[6] + y[2] * q[7];
      sum += (w * y[0]) * first + (w * y[1]) * second + (w * y[2]) * (q[2] + y[2] * q[8]);
    }
    const std::array<double, 6>& own = rows.own[static_cast<std::size_t>(a)];
    for (std::size_t r = 0; r < 6; ++r) sum += own[r] * G[a].h[r];
    f[a] -= sum;
  }
}

}  // namespace tessera
