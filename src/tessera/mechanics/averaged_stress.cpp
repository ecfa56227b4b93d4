#include "tessera/mechanics/averaged_stress.hpp"

#include <cmath>

#include "tessera/mechanics/cubature.hpp"
#include "tessera/mechanics/tile_nodes.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

/// Four consecutive particles, the last one repeated where there are fewer.
struct FourParticles {
  FourParticles(Index first, Index end) : a{}, lanes(std::min<Index>(4, end - first)) {
    for (Index lane = 0; lane < 4; ++lane) a[static_cast<std::size_t>(lane)] = first + std::min(lane, lanes - 1);
  }
  Lanes9 operator()(const Tensor* t) const { return to_lanes(t[a[0]], t[a[1]], t[a[2]], t[a[3]]); }
  Double4 operator()(const double* v) const { return Double4{v[a[0]], v[a[1]], v[a[2]], v[a[3]]}; }
  void store(const Double4& from, double* to) const {
    for (Index lane = 0; lane < lanes; ++lane) to[a[static_cast<std::size_t>(lane)]] = from[lane];
  }
  void store(const Lanes9& from, Tensor* to) const {
    const FourColumns columns = columns_of(from);
    for (Index lane = 0; lane < lanes; ++lane) tessera::store(to[a[static_cast<std::size_t>(lane)]], columns.t[lane]);
  }

  std::array<Index, 4> a;
  Index lanes;  // that count
};

/// What the sweeps over a range of particles read and write, one entry a particle.
struct ParticleArrays {
  const Tensor* F;
  const double* volume;
  const double* Jbar;
  const double* pbar;  // mean of p
  double* J;
  double* p;
  Tensor* P;
};

TESSERA_KERNEL void find_volume_changes(Index begin, Index end, const ParticleArrays& arrays) {
  for (Index first = begin; first < end; first += 4) {
    const FourParticles four(first, end);
    const Lanes9 F = four(arrays.F), cof = cofactor(F);
    four.store(F.xx * cof.xx + F.xy * cof.xy + F.xz * cof.xz, arrays.J);
  }
}

/// P without the mean of p, to which the neighbours belong.
template <class Law>
inline StressSums respond(const Law& law, Index begin, Index end, const ParticleArrays& arrays,
                          const HistorySpan& history) {
  StressSums sums;
  Double4 not_finite{};
  for (Index first = begin; first < end; first += 4) {
    const FourParticles four(first, end);
    const Lanes9 F = four(arrays.F);
    const Double4 J = four(arrays.J), Jbar = four(arrays.Jbar), scale = exp((1.0 / 3.0) * log(Jbar / J));
    Lanes9 Fbar, stress;
    add(Fbar, scale, F);
    const LanesResponse r = response(law, Fbar, history.lanes({four.a[0], four.a[1], four.a[2], four.a[3]}));
    const Double4 three_p = contract(r.stress, Fbar);
    add(stress, scale, r.stress);
    add(stress, (-1.0 / 3.0) * three_p / J, cofactor(F));
    four.store(stress, arrays.P);
    four.store((1.0 / 3.0) * three_p / Jbar, arrays.p);
    not_finite += J - J;
    for (Index lane = 0; lane < four.lanes; ++lane) {
      const double volume = arrays.volume[first + lane];
      sums.internal += volume * r.energy[lane];
      if constexpr (HasHistory<Law>) sums.dissipated += volume * r.dissipated[lane];
      sums.smallest_J = std::min(sums.smallest_J, J[lane]);
    }
  }
  sums.finite = std::isfinite(sum(not_finite));
  return sums;
}

// One clone of each law for every instruction set.
#define TESSERA_AVERAGED_KERNEL(Law)                                                                              \
  TESSERA_KERNEL StressSums averaged_kernel(const Law& law, Index begin, Index end, const ParticleArrays& arrays, \
                                            const HistorySpan& history) {                                         \
    return respond(law, begin, end, arrays, history);                                                             \
  }
TESSERA_FOR_EACH_LAW(TESSERA_AVERAGED_KERNEL)
#undef TESSERA_AVERAGED_KERNEL

/// P_a += (mean of p) J_a F_a^-T: from every Jbar that J_a is a part of.
TESSERA_KERNEL void add_mean_pressures(Index begin, Index end, const ParticleArrays& arrays) {
  for (Index first = begin; first < end; first += 4) {
    const FourParticles four(first, end);
    Lanes9 P = four(static_cast<const Tensor*>(arrays.P));
    add(P, four(arrays.pbar), cofactor(four(arrays.F)));
    four.store(P, arrays.P);
  }
}

template <class Body>
void for_ranges(const System& s, Body&& body) {
  parallel::for_ranges(0, s.particles(), [&](std::int64_t begin, std::int64_t end) {
    body(static_cast<Index>(begin), static_cast<Index>(end));
  });
}

}  // namespace

AveragedStress::AveragedStress(const System& s)
    : s_(s), J_(s.d.X.size()), Jbar_(J_), p_(J_), pbar_(J_), once_(J_), P_(s.d.X.size()) {}

StressSums AveragedStress::evaluate(const Tensor* F, const HistorySpan& history) {
  const ParticleArrays arrays{F, s_.d.volume.data(), Jbar_.data(), pbar_.data(), J_.data(), p_.data(), P_.data()};
  for_ranges(s_, [&](Index begin, Index end) { find_volume_changes(begin, end, arrays); });
  s_.average->mean_twice(J_, once_, Jbar_);
  StressSums sums;
  for (const MaterialRange& r : s_.ranges)
    sums += parallel::sum_ranges<StressSums>(r.begin, r.end, [&](std::int64_t begin, std::int64_t end) {
      return visit_law(s_.materials[static_cast<std::size_t>(r.material)].law, history.flow, [&](const auto& law) {
        return averaged_kernel(law, static_cast<Index>(begin), static_cast<Index>(end), arrays, history);
      });
    });
  s_.average->mean_twice(p_, once_, pbar_);
  for_ranges(s_, [&](Index begin, Index end) { add_mean_pressures(begin, end, arrays); });
  return sums;
}

Mat3 AveragedStress::law_deformation(std::size_t a, const Tensor& F) const {
  return std::cbrt(Jbar_[a] / J_[a]) * to_mat3(F);
}

}  // namespace tessera
