#include "tessera/mechanics/averaged_stress.hpp"

#include <cmath>

#include "tessera/laws/law_lanes.hpp"
#include "tessera/mechanics/tile_nodes.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

AveragedStress::AveragedStress(const System& s)
    : s_(s),
      J_(s.d.X.size()),
      p_(s.d.X.size()),
      once_(s.d.X.size()),
      mean_(s.d.X.size()),
      scale_(s.d.X.size()),
      P_(s.d.X.size()) {}

StressSums AveragedStress::evaluate(const Tensor* F, const HistorySpan& history) {
  volume_changes(F);
  StressSums sums;
  for (const MaterialRange& r : s_.ranges)
    sums += parallel::sum_ranges<StressSums>(r.begin, r.end, [&](std::int64_t begin, std::int64_t end) {
      return visit_law(s_.materials[static_cast<std::size_t>(r.material)].law, history.flow, [&](const auto& law) {
        return respond(law, static_cast<Index>(begin), static_cast<Index>(end), F, history);
      });
    });
  add_pressures(F);
  return sums;
}

void AveragedStress::volume_changes(const Tensor* F) {
  parallel::for_each(s_.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    J_[a] = determinant(to_mat3(F[a]));
  });
  s_.average->mean_twice(J_, once_, mean_);
}

/// P without the mean of p, to which the neighbours belong.
template <class Law>
StressSums AveragedStress::respond(const Law& law, Index begin, Index end, const Tensor* F,
                                   const HistorySpan& history) {
  StressSums sums;
  for (Index first = begin; first < end; first += 4) {
    const Index lanes = std::min<Index>(4, end - first);
    const auto at = [&](Index lane) { return first + std::min(lane, lanes - 1); };
    Lanes9 Fbar;
    for (Index lane = 0; lane < 4; ++lane) {
      const auto a = static_cast<std::size_t>(at(lane));
      scale_[a] = std::cbrt(mean_[a] / J_[a]);
      set_tensor(Fbar, lane, scale_[a] * to_mat3(F[a]));
    }
    const LanesResponse r = response(law, Fbar, history.lanes({at(0), at(1), at(2), at(3)}));
    const Double4 p = contract(r.stress, Fbar);
    for (Index lane = 0; lane < lanes; ++lane) {
      const auto a = static_cast<std::size_t>(first + lane);
      P_[a] = to_tensor(scale_[a] * tensor_of(r.stress, lane) - (p[lane] / (3.0 * J_[a])) * cofactor(to_mat3(F[a])));
      p_[a] = p[lane] / (3.0 * r.J[lane]);
      sums.internal += s_.d.volume[a] * r.energy[lane];
      if constexpr (HasHistory<Law>) sums.dissipated += s_.d.volume[a] * r.dissipated[lane];
      sums.smallest_J = std::min(sums.smallest_J, J_[a]);
      sums.finite = sums.finite && std::isfinite(J_[a]);
    }
  }
  return sums;
}

/// P_a += (mean of p) J_a F_a^-T: from every Jbar that J_a is a part of.
void AveragedStress::add_pressures(const Tensor* F) {
  s_.average->mean_twice(p_, once_, mean_);
  parallel::for_each(s_.particles(), [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    P_[a] = to_tensor(to_mat3(P_[a]) + mean_[a] * cofactor(to_mat3(F[a])));
  });
}

}  // namespace tessera
