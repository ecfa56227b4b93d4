#include "tessera/mechanics/second_order.hpp"

#include <algorithm>

#include "tessera/mechanics/cell_sweeps.hpp"
#include "tessera/mechanics/curvature_nodes.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

using GradientTerm = SecondOrderSystem::GradientTerm;

/// Weights of the neighbours' F_b - F_a in F at the points: least squares of a linear F, weights 1/r^2 between
/// centroids.
void add_gradient_row(const Discretization& d, Index a, const Mat3& to_points, Csr<GradientTerm>& rows) {
  const std::vector<Vec3>& C = d.measure->centroid;
  d.for_each_face_neighbour(a, [&](Offset, Index b) {
    const Vec3 c = C[static_cast<std::size_t>(b)] - C[static_cast<std::size_t>(a)];
    rows.value.push_back({b, (1.0 / norm2(c)) * (transpose(to_points) * c)});
  });
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

/// Calls body(surface) for the surfaces of all cells at free boundaries, one for each cell, and ahead(particle) for
/// what comes later.
template <class Body, class Ahead>
void for_all_surfaces(const System& s, Body&& body, Ahead&& ahead) {
  const std::vector<CurvedSurface>& surfaces = s.second_order->surfaces;
  const std::size_t last = surfaces.empty() ? 0 : surfaces.size() - 1;
  parallel::for_each(static_cast<std::int64_t>(surfaces.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    ahead(surfaces[std::min(k + lookahead, last)].particle);
    body(surfaces[k]);
  });
}

template <class Body>
void for_all_tiles(const System& s, const SecondOrderMemory& memory, Body&& body) {
  parallel::for_tasks(s.tiles.size(), [&](std::int64_t tile) {
    const parallel::Workspaces<CurvatureScratch>::Lease scratch(memory.scratch);
    body(static_cast<Index>(tile), *scratch);
  });
}

/// Cells that use means have them from now on.
void take_sums(const SecondOrderSystem& s, SecondOrderMemory& memory) {
  parallel::for_each(static_cast<std::int64_t>(s.averaged.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    fetch_all(memory.weighted.data() + s.averaged[std::min(k + lookahead, s.averaged.size() - 1)]);
    memory.weighted[static_cast<std::size_t>(s.averaged[k])] = memory.sums[k];
  });
}

void add_surface_strain(const System& s, const Hessian* weighted, Tensor* F) {
  for_all_surfaces(
      s,
      [&](const CurvedSurface& c) {
        Tensor& F_a = F[c.particle];
        const auto a = static_cast<std::size_t>(c.particle);
        const double share = s.second_order->rows.inverse_sum[a] / s.d.volume[a];
        for (std::size_t r = 0; r < 6; ++r)
          for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t i = 0; i < 3; ++i)
              F_a.m[3 * j + i] += share * weighted[c.particle].h[3 * r + i] * c.area_moment[r][static_cast<int>(j)];
      },
      [&](Index later) { fetch(F + later), fetch_all(weighted + later); });
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
  for (Index a = 0; a < d.particles(); ++a)
    if (d.second_order->derivatives.averaged[static_cast<std::size_t>(a)]) s.averaged.push_back(a);
  s.surfaces = d.second_order->surfaces;
  return s;
}

SecondOrderMemory::SecondOrderMemory(const System& s)
    : scratch([&tiles = s.tiles] { return std::make_unique<CurvatureScratch>(tiles); }) {
  if (!s.second_order) return;
  const auto particles = static_cast<std::size_t>(s.particles());
  weighted.resize(particles);
  sums.resize(static_cast<std::size_t>(s.second_order->rows.start.back().averaged));
  moments.resize(particles);
  unresolved.resize(s.second_order->unresolved.size());
  if (s.average) points.resize(particles);
  T.resize(particles);
}

void find_strain(const System& s, const Double4* x, SecondOrderMemory& memory, Tensor* F) {
  for_all_tiles(s, memory, [&](Index tile, CurvatureScratch& scratch) {
    derivative_sweep(s, tile, x, scratch, F, memory.weighted.data());
  });
  for_all_tiles(s, memory, [&](Index tile, CurvatureScratch& scratch) {
    face_sweep(s, tile, memory.weighted.data(), scratch, F, memory.sums.data());
  });
  take_sums(*s.second_order, memory);
  add_surface_strain(s, memory.weighted.data(), F);
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
    point_strain_sweep(s.points.data(), s.rows.inverse_sum.data(), static_cast<Index>(begin), static_cast<Index>(end),
                       memory.weighted.data(), memory.points.data());
  });
  for (std::size_t k = 0; k < s.unresolved.size(); ++k)
    memory.points[static_cast<std::size_t>(s.unresolved[k])] = memory.unresolved[k];
}

void take_point_moments(const SecondOrderSystem& s, SecondOrderMemory& memory) {
  parallel::for_ranges(0, static_cast<std::int64_t>(s.points.size()), [&](std::int64_t begin, std::int64_t end) {
    point_moment_sweep(s.points.data(), s.rows.inverse_sum.data(), static_cast<Index>(begin), static_cast<Index>(end),
                       memory.points.data(), memory.moments.data());
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

void add_surface_moments(const System& s, SecondOrderMemory& memory) {
  for_all_surfaces(
      s,
      [&](const CurvedSurface& c) {
        const auto a = static_cast<std::size_t>(c.particle);
        const double share = s.second_order->rows.inverse_sum[a];
        for (std::size_t r = 0; r < 6; ++r) {
          const Double4 force = share * apply(to_kernel(memory.T[a]), c.area_moment[r]);
          for (std::size_t i = 0; i < 3; ++i) memory.moments[a].h[3 * r + i] += force[static_cast<int>(i)];
        }
      },
      [&](Index later) { fetch(memory.T.data() + later), fetch_all(memory.moments.data() + later); });
}

void add_forces(const System& s, Index tile, const SecondOrderMemory& memory, Double4* f, Double4* rim_f) {
  const parallel::Workspaces<CurvatureScratch>::Lease scratch(memory.scratch);
  derivative_force_sweep(s, tile, memory.T.data(), memory.moments.data(), *scratch, f, rim_f);
}

}  // namespace tessera
