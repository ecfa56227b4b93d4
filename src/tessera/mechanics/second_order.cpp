#include "tessera/mechanics/second_order.hpp"

#include <algorithm>

#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

using GradientTerm = SecondOrderSystem::GradientTerm;

Columns operator-(const Columns& a, const Columns& b) { return {a.c0 - b.c0, a.c1 - b.c1, a.c2 - b.c2}; }

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
  struct Target {
    Index receiver;
    GradientTerm term;
  };
  std::vector<Target> targets;
  for (std::size_t k = 0; k < s.unresolved.size(); ++k)
    for (const GradientTerm& t : s.gradients.row(static_cast<Index>(k))) {
      targets.push_back({t.cell, {static_cast<Index>(k), t.weight}});
      targets.push_back({s.unresolved[k], {static_cast<Index>(k), -t.weight}});
    }
  std::stable_sort(targets.begin(), targets.end(),
                   [](const Target& l, const Target& r) { return l.receiver < r.receiver; });
  for (const Target& t : targets) {
    if (s.receivers.empty() || s.receivers.back() != t.receiver) {
      s.receivers.push_back(t.receiver);
      s.returned.offset.push_back(s.returned.offset.back());
    }
    s.returned.value.push_back(t.term);
    ++s.returned.offset.back();
  }
}

/// Calls body(k, a) for the unresolved cells in [begin, end): number and particle.
template <class Body>
void for_unresolved(const SecondOrderSystem& s, Index begin, Index end, Body&& body) {
  const auto first = std::lower_bound(s.unresolved.begin(), s.unresolved.end(), begin);
  for (auto it = first; it != s.unresolved.end() && *it < end; ++it)
    body(static_cast<Index>(it - s.unresolved.begin()), *it);
}

template <class Body>
void for_all_particles(const SecondOrderSystem& s, Body&& body) {
  parallel::for_ranges(0, static_cast<std::int64_t>(s.points.size()), [&](std::int64_t begin, std::int64_t end) {
    body(static_cast<Index>(begin), static_cast<Index>(end));
  });
}

}  // namespace

SecondOrderSystem second_order_system(const Discretization& d) {
  SecondOrderSystem s;
  s.rows = hessian_rows(d);
  const CellGradients gradients = cell_gradients(d);
  s.points.resize(d.X.size());
  parallel::for_each(d.particles(), [&](std::int64_t a) {
    s.points[static_cast<std::size_t>(a)] = cubature_points(d.measure->second_moment[static_cast<std::size_t>(a)]);
  });
  for (Index a = 0; a < d.particles(); ++a) {
    if (d.second_order->fits.resolved[static_cast<std::size_t>(a)]) continue;
    s.unresolved.push_back(a);
    add_gradient_row(d, a, gradients.to_points[static_cast<std::size_t>(a)], s.gradients);
  }
  transpose_gradients(s);
  return s;
}

void find_hessians(const SecondOrderSystem& s, const Double4* x, SecondOrderMemory& memory) {
  for_all_particles(s, [&](Index begin, Index end) { hessian_sweep(s.rows, begin, end, x, memory.H.data()); });
}

void add_curvature_strain(const SecondOrderSystem& s, const double* volume, const SecondOrderMemory& memory,
                          Tensor* F) {
  for_all_particles(
      s, [&](Index begin, Index end) { curvature_strain_sweep(s.rows, volume, begin, end, memory.H.data(), F); });
}

void find_point_strains(const SecondOrderSystem& s, Index begin, Index end, const Tensor* F,
                        SecondOrderMemory& memory) {
  point_strain_sweep(s.points.data(), begin, end, memory.H.data(), memory.points.data());
  for_unresolved(s, begin, end, [&](Index k, Index a) {
    ThreeTensors E{};
    const Columns F_a = to_kernel(F[a]);
    for (const GradientTerm& t : s.gradients.row(k))
      for (int q = 0; q < 3; ++q) E.k[q] = E.k[q] + t.weight[q] * (to_kernel(F[t.cell]) - F_a);
    memory.points[static_cast<std::size_t>(a)] = E;
  });
}

void take_moments(const SecondOrderSystem& s, Index begin, Index end, SecondOrderMemory& memory) {
  point_moment_sweep(s.points.data(), begin, end, memory.points.data(), memory.H.data());
  for_unresolved(s, begin, end, [&](Index, Index a) { memory.H[static_cast<std::size_t>(a)] = {}; });
}

void return_gradients(const SecondOrderSystem& s, const double* volume, SecondOrderMemory& memory) {
  parallel::for_each(static_cast<std::int64_t>(s.receivers.size()), [&](std::int64_t i) {
    const auto b = static_cast<std::size_t>(s.receivers[static_cast<std::size_t>(i)]);
    Columns sum{};
    for (const GradientTerm& t : s.returned.row(static_cast<Index>(i))) {
      const ThreeTensors& Z = memory.points[static_cast<std::size_t>(s.unresolved[static_cast<std::size_t>(t.cell)])];
      for (int q = 0; q < 3; ++q) sum = sum + t.weight[q] * Z.k[q];
    }
    memory.T[b] = to_tensor(to_kernel(memory.T[b]) + (1.0 / volume[b]) * sum);
  });
}

void add_hessian_forces(const SecondOrderSystem& s, SecondOrderMemory& memory, Double4* f) {
  for_all_particles(s, [&](Index begin, Index end) {
    curvature_moment_sweep(s.rows, begin, end, memory.T.data(), memory.H.data(), memory.moments.data());
  });
  for_all_particles(s, [&](Index begin, Index end) {
    hessian_force_sweep(s.rows, begin, end, memory.H.data(), memory.moments.data(), f);
  });
}

}  // namespace tessera
