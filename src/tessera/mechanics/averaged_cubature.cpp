#include "tessera/mechanics/averaged_cubature.hpp"

#include <cmath>

#include "tessera/mechanics/isochoric_cubature.hpp"
#include "tessera/mechanics/tile_nodes.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

/// What the sweep over the points of a range of cells reads and writes, one entry a cell.
struct PointArrays {
  const Tensor* F;
  const ThreeTensors* E;
  const double* Jbar;
  const double* volume;
  Tensor* P;
  ThreeTensors* moments;
  double* p;
};

/// Four consecutive cells, the last one repeated where there are fewer.
struct FourCells {
  std::array<std::size_t, 4> a;
  Index lanes;  // that count

  FourCells(Index first, Index end) : a{}, lanes(std::min<Index>(4, end - first)) {
    for (Index lane = 0; lane < 4; ++lane)
      a[static_cast<std::size_t>(lane)] = static_cast<std::size_t>(first + std::min(lane, lanes - 1));
  }

  /// Lanes that repeat a cell keep nothing.
  LanesHistory history(const HistorySpan& all, int point) const {
    if (all.before == nullptr) return {};
    std::array<Offset, 4> points{};
    for (std::size_t lane = 0; lane < 4; ++lane)
      points[lane] = static_cast<Offset>(a[lane]) * stress_points_of_a_cell + point;
    LanesHistory four = all.lanes(points);
    for (auto lane = static_cast<std::size_t>(lanes); lane < 4; ++lane) four.after[lane] = nullptr;
    return four;
  }
};

template <class Law>
inline StressSums points_of(const Law& law, Index begin, Index end, const PointArrays& arrays,
                            const HistorySpan& history, const CellReport& report) {
  StressSums sums;
  Double4 not_finite{};
  for (Index first = begin; first < end; first += 4) {
    const FourCells cells(first, end);
    const auto& a = cells.a;
    Lanes9 E[3];
    for (int q = 0; q < 3; ++q)
      E[q] = to_lanes(arrays.E[a[0]].k[q], arrays.E[a[1]].k[q], arrays.E[a[2]].k[q], arrays.E[a[3]].k[q]);
    const Double4 Jbar{arrays.Jbar[a[0]], arrays.Jbar[a[1]], arrays.Jbar[a[2]], arrays.Jbar[a[3]]};
    const IsochoricStress<Double4> c =
        isochoric_stress(law, to_lanes(arrays.F[a[0]], arrays.F[a[1]], arrays.F[a[2]], arrays.F[a[3]]), E, Jbar,
                         [&](int point) { return cells.history(history, point); });
    const FourColumns mean = columns_of(c.sums.mean),
                      moment[3] = {columns_of(c.sums.moment[0]), columns_of(c.sums.moment[1]),
                                   columns_of(c.sums.moment[2])};
    for (Index lane = 0; lane < cells.lanes; ++lane) {
      const std::size_t k = a[static_cast<std::size_t>(lane)];
      const double V = arrays.volume[k];
      arrays.P[k] = to_tensor(mean.t[lane]);
      for (int q = 0; q < 3; ++q) arrays.moments[k].k[q] = V * moment[q].t[lane];
      arrays.p[k] = c.p[lane];
      sums.internal += V * c.sums.energy[lane];
      if constexpr (HasHistory<Law>) sums.dissipated += V * c.sums.dissipated[lane];
      sums.smallest_J = std::min(sums.smallest_J, c.sums.smallest_J[lane]);
      if (report.smallest_J != nullptr) report.smallest_J[k] = c.sums.smallest_J[lane];
      if (report.energy != nullptr) report.energy[k] = c.sums.energy[lane];
    }
    not_finite += c.sums.not_finite;
  }
  sums.finite = std::isfinite(sum(not_finite));
  return sums;
}

// One clone of each law for every instruction set.
#define TESSERA_POINTS_KERNEL(Law)                                                                           \
  TESSERA_KERNEL StressSums points_kernel(const Law& law, Index begin, Index end, const PointArrays& arrays, \
                                          const HistorySpan& history, const CellReport& report) {            \
    return points_of(law, begin, end, arrays, history, report);                                              \
  }
TESSERA_FOR_EACH_LAW(TESSERA_POINTS_KERNEL)
#undef TESSERA_POINTS_KERNEL

/// (1/3) sum_q cof E_q: the mean of cof(F +- E_q) over the points less cof F.
Mat3 mean_cofactor(const ThreeTensors& E) {
  return (1.0 / 3.0) * (cofactor(to_mat3(E.k[0])) + cofactor(to_mat3(E.k[1])) + cofactor(to_mat3(E.k[2])));
}

}  // namespace

AveragedCubature::AveragedCubature(const System& s)
    : s_(s),
      J_(s.d.X.size()),
      p_(s.d.X.size()),
      once_(s.d.X.size()),
      mean_(s.d.X.size()),
      P_(s.d.X.size()),
      moments_(s.d.X.size()) {}

StressSums AveragedCubature::evaluate(const Tensor* F, ThreeTensors* points, const HistorySpan& history,
                                      const CellReport& report) {
  volume_changes(F, points);
  const PointArrays arrays{F, points, mean_.data(), s_.d.volume.data(), P_.data(), moments_.data(), p_.data()};
  StressSums sums;
  for (const MaterialRange& r : s_.ranges)
    sums += parallel::sum_ranges<StressSums>(r.begin, r.end, [&](std::int64_t begin, std::int64_t end) {
      return visit_law(s_.materials[static_cast<std::size_t>(r.material)].law, history.flow, [&](const auto& law) {
        return points_kernel(law, static_cast<Index>(begin), static_cast<Index>(end), arrays, history, report);
      });
    });
  add_pressures(F, points);
  if (report.mean != nullptr) std::copy(P_.begin(), P_.end(), report.mean);
  return sums;
}

/// The mean of det(F +- E_q) is det F + (1/3) sum_q F : cof E_q.
void AveragedCubature::volume_changes(const Tensor* F, const ThreeTensors* E) {
  parallel::for_each(s_.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    const Mat3 F_a = to_mat3(F[a]);
    J_[a] = determinant(F_a) + contract(F_a, mean_cofactor(E[a]));
  });
  s_.average->mean_twice(J_, once_, mean_);
}

/// By J_a, of which every Jbar around it has a part: dJ_a/dE_q = (1/6) (cof(F + E_q) - cof(F - E_q)).
void AveragedCubature::add_pressures(const Tensor* F, ThreeTensors* points) {
  s_.average->mean_twice(p_, once_, J_);
  parallel::for_each(s_.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    const Mat3 F_a = to_mat3(F[a]);
    P_[a] = to_tensor(to_mat3(P_[a]) + J_[a] * (cofactor(F_a) + mean_cofactor(points[a])));
    for (int q = 0; q < 3; ++q) {
      const Mat3 E = to_mat3(points[a].k[q]);
      points[a].k[q] = moments_[a].k[q] + to_kernel((s_.d.volume[a] * J_[a] / stress_points_of_a_cell) *
                                                    (cofactor(F_a + E) - cofactor(F_a - E)));
    }
  });
}

Mat3 AveragedCubature::law_deformation(std::size_t a, const Tensor& F) const {
  const Mat3 F_a = to_mat3(F);
  return std::cbrt(mean_[a] / determinant(F_a)) * F_a;
}

}  // namespace tessera
