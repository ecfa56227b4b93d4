#include "tessera/mechanics/second_order.hpp"

#include <algorithm>

#include "tessera/mechanics/cell_sweeps.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

using GradientTerm = SecondOrderSystem::GradientTerm;

/// Weights of the neighbours' F_b - F_a in F at the points: least squares of a linear F, weights 1/r^2 between
/// centroids.
void add_gradient_row(const Discretization& d, Index a, const Mat3& to_points, Csr<GradientTerm>& rows) {
  const std::vector<Vec3>& C = d.measure->centroid;
  for (Offset i = d.bonds.begin(a); i < d.bonds.end(a); ++i) {
    const auto bond = static_cast<std::size_t>(i);
    if (d.bonds.area_over_length[bond] == 0.0) continue;
    const Index b = d.bonds.neighbour[bond];
    const Vec3 c = C[static_cast<std::size_t>(b)] - C[static_cast<std::size_t>(a)];
    rows.value.push_back({b, (1.0 / norm2(c)) * (transpose(to_points) * c)});
  }
  rows.offset.push_back(static_cast<Offset>(rows.value.size()));
}

void transpose_gradients(SecondOrderSystem& s) {
  std::vector<RowItem<GradientTerm>> targets;
  for (std::size_t k = 0; k < s.unresolved.size(); ++k)
    for (const GradientTerm& t : s.gradients.row(static_cast<Index>(k))) {
      targets.push_back({t.cell, {static_cast<Index>(k), t.weight}});
      targets.push_back({s.unresolved[k], {static_cast<Index>(k), -t.weight}});
    }
  s.returned = group_by_used_row(std::move(targets), s.receivers);
}

void transpose_faces(SecondOrderSystem& s) {
  std::vector<RowItem<SecondOrderSystem::FaceShare>> targets;
  for (Index k = 0; k < s.extrapolated.rows(); ++k)
    for (const FaceTerm& t : s.extrapolated.row(k)) targets.push_back({t.particle, {k, t.weight}});
  s.face_shares = group_by_used_row(std::move(targets), s.extrapolating);
}

/// Adds the extrapolated faces, times the sign, to F of their owners.
void add_extrapolated_strain(const System& s, double sign, const Double4* x, Tensor* F) {
  const SecondOrderSystem& c = *s.second_order;
  parallel::for_each(static_cast<std::int64_t>(s.owners.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const Index a = s.owners[k];
    Columns sum{};
    for (Index f = s.first_node[k]; f < s.first_node[k + 1]; ++f) {
      Double4 way{};
      for (const FaceTerm& t : c.extrapolated.row(f)) way += t.weight * (x[t.particle] - x[a]);
      add_outer(sum, way, c.held[static_cast<std::size_t>(f)].area);
    }
    F[a] = to_tensor(to_kernel(F[a]) + (sign / s.d.volume[static_cast<std::size_t>(a)]) * sum);
  });
}

/// Calls body(surface) for the surfaces of all cells at free boundaries, one for each cell.
template <class Body>
void for_all_surfaces(const System& s, Body&& body) {
  const std::vector<CurvedSurface>& surfaces = s.second_order->surfaces;
  parallel::for_each(static_cast<std::int64_t>(surfaces.size()),
                     [&](std::int64_t k) { body(surfaces[static_cast<std::size_t>(k)]); });
}

template <class Body>
void for_all_tiles(const System& s, const SecondOrderMemory& memory, Body&& body) {
  parallel::for_tasks(s.tiles.size(), [&](std::int64_t tile) {
    const parallel::Workspaces<CurvatureScratch>::Lease scratch(memory.scratch);
    body(static_cast<Index>(tile), *scratch);
  });
}

void add_surface_strain(const System& s, const Hessian* H, Tensor* F) {
  for_all_surfaces(s, [&](const CurvedSurface& c) {
    Tensor& F_a = F[c.particle];
    const double inverse_volume = 1.0 / s.d.volume[static_cast<std::size_t>(c.particle)];
    for (std::size_t r = 0; r < 6; ++r)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i)
          F_a.m[3 * j + i] += inverse_volume * H[c.particle].h[3 * r + i] * c.area_moment[r][static_cast<int>(j)];
  });
}

void add_surface_moments(const System& s, const Tensor* T, Hessian* G) {
  for_all_surfaces(s, [&](const CurvedSurface& c) {
    const double share = s.second_order->rows.inverse_sum[static_cast<std::size_t>(c.particle)];
    for (std::size_t r = 0; r < 6; ++r) {
      const Double4 force = share * apply(to_kernel(T[c.particle]), c.area_moment[r]);
      for (std::size_t i = 0; i < 3; ++i) G[c.particle].h[3 * r + i] += force[static_cast<int>(i)];
    }
  });
}

}  // namespace

SecondOrderSystem second_order_system(const Discretization& d, const Tiles& tiles) {
  SecondOrderSystem s;
  s.rows = curvature_rows(d, tiles);
  const CellGradients gradients = cell_gradients(d);
  s.points.resize(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t a) {
    const Mat3 p = cubature_points(d.measure->second_moment[static_cast<std::size_t>(a)]);
    s.points[static_cast<std::size_t>(a)] = {p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2)};
  });
  for (Index a = 0; a < d.particles(); ++a) {
    if (d.second_order->derivatives.resolved[static_cast<std::size_t>(a)]) continue;
    s.unresolved.push_back(a);
    add_gradient_row(d, a, gradients.to_points[static_cast<std::size_t>(a)], s.gradients);
  }
  transpose_gradients(s);
  s.surfaces = d.second_order->surfaces;
  s.held = d.second_order->held;
  s.extrapolated = d.second_order->extrapolated;
  transpose_faces(s);
  return s;
}

SecondOrderMemory::SecondOrderMemory(const System& s)
    : scratch([&tiles = s.tiles] { return std::make_unique<CurvatureScratch>(tiles); }) {
  if (!s.second_order) return;
  const auto particles = static_cast<std::size_t>(s.particles());
  weighted.resize(particles);
  H.resize(particles);
  unresolved.resize(s.second_order->unresolved.size());
  if (s.average) points.resize(particles);
  T.resize(particles);
  T_first.resize(particles);
  rim_energies.resize(s.tiles.rim.size());
}

void add_curvature_strain(const System& s, const Double4* x, SecondOrderMemory& memory, Tensor* F) {
  add_extrapolated_strain(s, 1.0, x, F);
  for_all_tiles(s, memory, [&](Index tile, CurvatureScratch& scratch) {
    hessian_sweep(s, tile, F, scratch, memory.weighted.data());
  });
  for_all_tiles(s, memory, [&](Index tile, CurvatureScratch& scratch) {
    curvature_strain_sweep(s, tile, memory.weighted.data(), scratch, F, memory.H.data());
  });
  add_surface_strain(s, memory.H.data(), F);
  add_extrapolated_strain(s, -1.0, x, F);
}

void find_unresolved_strains(const SecondOrderSystem& s, const Tensor* F, SecondOrderMemory& memory) {
  parallel::for_each(static_cast<std::int64_t>(s.unresolved.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    ThreeTensors E{};
    const Columns F_a = to_kernel(F[s.unresolved[k]]);
    for (const GradientTerm& t : s.gradients.row(static_cast<Index>(i)))
      for (int q = 0; q < 3; ++q) E.k[q] = E.k[q] + t.weight[q] * (to_kernel(F[t.cell]) - F_a);
    memory.unresolved[k] = E;
  });
}

void find_point_strains(const SecondOrderSystem& s, SecondOrderMemory& memory) {
  parallel::for_ranges(0, static_cast<std::int64_t>(s.points.size()), [&](std::int64_t begin, std::int64_t end) {
    point_strain_sweep(s.points.data(), static_cast<Index>(begin), static_cast<Index>(end), memory.H.data(),
                       memory.points.data());
  });
  for (std::size_t k = 0; k < s.unresolved.size(); ++k)
    memory.points[static_cast<std::size_t>(s.unresolved[k])] = memory.unresolved[k];
}

void take_point_moments(const SecondOrderSystem& s, SecondOrderMemory& memory) {
  parallel::for_ranges(0, static_cast<std::int64_t>(s.points.size()), [&](std::int64_t begin, std::int64_t end) {
    point_moment_sweep(s.points.data(), s.rows.inverse_sum.data(), static_cast<Index>(begin), static_cast<Index>(end),
                       memory.points.data(), memory.weighted.data());
  });
  for (std::size_t k = 0; k < s.unresolved.size(); ++k)
    memory.unresolved[k] = memory.points[static_cast<std::size_t>(s.unresolved[k])];
}

void return_gradients(const SecondOrderSystem& s, const double* volume, SecondOrderMemory& memory) {
  parallel::for_each(static_cast<std::int64_t>(s.receivers.size()), [&](std::int64_t i) {
    const auto b = static_cast<std::size_t>(s.receivers[static_cast<std::size_t>(i)]);
    Columns sum{};
    for (const GradientTerm& t : s.returned.row(static_cast<Index>(i))) {
      const ThreeTensors& Z = memory.unresolved[static_cast<std::size_t>(t.cell)];
      for (int q = 0; q < 3; ++q) sum = sum + t.weight[q] * Z.k[q];
    }
    memory.T[b] = to_tensor(to_kernel(memory.T[b]) + (1.0 / volume[b]) * sum);
  });
}

void return_curvature(const System& s, SecondOrderMemory& memory) {
  add_surface_moments(s, memory.T.data(), memory.weighted.data());
  for_all_tiles(s, memory, [&](Index tile, CurvatureScratch& scratch) {
    curvature_moment_sweep(s, tile, memory.T.data(), memory.weighted.data(), scratch, memory.T_first.data(),
                           memory.rim_energies.data());
  });
}

void recall_first(const System& s, Index tile, SecondOrderMemory& memory, Columns* T) {
  const Tile& t = s.tiles.tiles[static_cast<std::size_t>(tile)];
  complete_stresses(s, tile, memory.T_first.data(), memory.rim_energies.data(), T);
  for (Index k = t.first_owner; k < s.tiles.end_of(tile).first_owner; ++k) {
    const Index a = s.owners[static_cast<std::size_t>(k)];
    memory.T_first[static_cast<std::size_t>(a)] = to_tensor(T[a - t.begin]);
  }
}

void add_extrapolated_forces(const SecondOrderSystem& s, const SecondOrderMemory& memory, Double4* f) {
  parallel::for_each(static_cast<std::int64_t>(s.extrapolating.size()), [&](std::int64_t i) {
    Double4 sum{};
    for (const SecondOrderSystem::FaceShare& t : s.face_shares.row(static_cast<Index>(i))) {
      const HeldFace& face = s.held[static_cast<std::size_t>(t.face)];
      const auto a = static_cast<std::size_t>(face.owner);
      sum += t.weight * apply(to_kernel(memory.T_first[a]) - to_kernel(memory.T[a]), face.area);
    }
    f[s.extrapolating[static_cast<std::size_t>(i)]] -= sum;
  });
}

}  // namespace tessera
