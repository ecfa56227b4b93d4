#include "tessera/mechanics/sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/laws/law_lanes.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

namespace tessera {

StressSums& StressSums::operator+=(const StressSums& o) {
  internal += o.internal;
  contact += o.contact;
  dissipated += o.dissipated;
  smallest_J = std::min(smallest_J, o.smallest_J);
  finite = finite && o.finite;
  return *this;
}

TileScratch::TileScratch(const System& s)
    : x(static_cast<std::size_t>(s.tiles.most_nodes)),
      nodes(static_cast<std::size_t>(s.tiles.most_nodes)),
      T(static_cast<std::size_t>(s.tiles.most_particles)) {
  if (!s.gradients) return;
  centroid.resize(nodes.size());
  moments.resize(T.size());
  Offset most_slots = 0;
  for (Index k = 0; k < s.tiles.size(); ++k)
    most_slots = std::max(most_slots, s.tiles.end_of(k).slot - tile_of(s, k).slot);
  gradient_weights.resize(static_cast<std::size_t>(most_slots));
}

TESSERA_KERNEL void strain_sweep(const System& s, Index k, const Double4* x, Tensor* F, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  Double4* __restrict x_local = scratch.x.data();
  for (Index a = 0; a < own; ++a) x_local[a] = x[tile.begin + a];
  for (Index i = 0; i < rim_size; ++i) {
    fetch(x + rim[std::min(i + lookahead, rim_size - 1)]);
    x_local[own + i] = x[rim[i]];
  }
  const Vec3* B = s.tiles.B.data() + tile.slot;
  const std::uint16_t* neighbour = s.tiles.neighbour.data() + tile.slot;
  const std::uint16_t* order = s.tiles.order.data() + quad * tile.quad;
  const std::uint16_t* length = s.tiles.length.data() + tile.quad;
  const double* volume = s.d.volume.data() + tile.begin;
  Tensor* __restrict F_own = F + tile.begin;
  for (Index q = 0; q < tile.quads(); ++q, order += quad) {
    const Double4 x_a[quad] = {x_local[order[0]], x_local[order[1]], x_local[order[2]], x_local[order[3]]};
    Columns VF[quad]{};
    for (Index i = 0; i < length[q]; ++i, neighbour += quad, B += quad) {
      fetch_ahead<1536>(B);
      fetch_ahead<1600>(B);
      fetch_ahead<512>(neighbour);
      for (Index lane = 0; lane < quad; ++lane) add_outer(VF[lane], x_local[neighbour[lane]] - x_a[lane], B[lane]);
    }
    for (Index line = 0; line < 5; ++line)
      fetch_to_write<6912>(reinterpret_cast<const char*>(F_own + quad * q) + 64 * line);
    const Index lanes = std::min(quad, own - quad * q);
    for (Index lane = 0; lane < lanes; ++lane) store(F_own[order[lane]], (1.0 / volume[order[lane]]) * VF[lane]);
  }
}

namespace {

/// Tensor k of four.
inline Columns columns_of(const Lanes9& t, int k) {
  return {Double4{t.xx[k], t.yx[k], t.zx[k], 0.0}, Double4{t.xy[k], t.yy[k], t.zy[k], 0.0},
          Double4{t.xz[k], t.yz[k], t.zz[k], 0.0}};
}

/// Adds the elastic and viscous stress of the tile's own particle to T, or puts it where it goes another way.
inline void take_stress(TileScratch& scratch, Index local, const Columns& P) {
  const auto k = static_cast<std::size_t>(local);
  if (scratch.P.empty())
    scratch.T[k] = scratch.T[k] + P;
  else
    scratch.P[k] = P;
}

template <class Law>
inline StressSums stress_of(const System& s, const Tile& tile, const Law& law, const Tensor* F,
                            const HistorySpan& history, ViscousMemory* viscous, double dt, TileScratch& scratch) {
  const double* volume = s.d.volume.data();
  StressSums sums;
  Double4 smallest_J{};
  smallest_J += std::numeric_limits<double>::infinity();
  Double4 not_finite{};
  for (Index first = tile.begin; first < tile.end; first += 4) {
    const Index lanes = std::min<Index>(4, tile.end - first);
    const auto at = [&](Index lane) { return first + std::min(lane, lanes - 1); };
    const LanesResponse response_4 =
        response(law, to_lanes(F[at(0)], F[at(1)], F[at(2)], F[at(3)]), history.lanes({at(0), at(1), at(2), at(3)}));
    smallest_J = smallest_J < response_4.J ? smallest_J : response_4.J;
    not_finite += response_4.J - response_4.J;
    for (Index lane = 0; lane < lanes; ++lane) {
      const Index a = first + lane, local = a - tile.begin;
      sums.internal += volume[a] * response_4.energy[lane];
      if constexpr (HasHistory<Law>) sums.dissipated += volume[a] * response_4.dissipated[lane];
      Columns P = columns_of(response_4.stress, lane);
      if (viscous != nullptr && dt > 0.0) sums.dissipated += add_viscous_stress(s, a, F[a], *viscous, dt, P);
      take_stress(scratch, local, P);
    }
  }
  sums.smallest_J = std::min(std::min(smallest_J[0], smallest_J[1]), std::min(smallest_J[2], smallest_J[3]));
  sums.finite = std::isfinite(sum(not_finite));
  return sums;
}

// One clone of each law for every instruction set.
#define TESSERA_STRESS_KERNEL(Law)                                                                            \
  TESSERA_KERNEL StressSums stress_kernel(const System& s, const Tile& tile, const Law& law, const Tensor* F, \
                                          const HistorySpan& history, ViscousMemory* viscous, double dt,      \
                                          TileScratch& scratch) {                                             \
    return stress_of(s, tile, law, F, history, viscous, dt, scratch);                                         \
  }
TESSERA_STRESS_KERNEL(NeoHookean)
TESSERA_STRESS_KERNEL(SaintVenantKirchhoff)
TESSERA_STRESS_KERNEL(MooneyRivlin)
TESSERA_STRESS_KERNEL(Ogden)
TESSERA_STRESS_KERNEL(J2Plasticity)
#undef TESSERA_STRESS_KERNEL

}  // namespace

StressSums stress_sweep(const System& s, Index k, const Tensor* F, const HistorySpan& history, ViscousMemory* viscous,
                        double dt, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  return visit_law(s.materials[static_cast<std::size_t>(tile.material)].law, history.flow,
                   [&](const auto& law) { return stress_kernel(s, tile, law, F, history, viscous, dt, scratch); });
}

StressSums known_stress_sweep(const System& s, Index k, const Tensor* F, const Tensor* P, ViscousMemory* viscous,
                              double dt, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  StressSums sums;
  for (Index a = tile.begin; a < tile.end; ++a) {
    Columns P_a = to_kernel(P[a]);
    if (viscous != nullptr && dt > 0.0) sums.dissipated += add_viscous_stress(s, a, F[a], *viscous, dt, P_a);
    take_stress(scratch, a - tile.begin, P_a);
  }
  return sums;
}

TESSERA_KERNEL void force_sweep(const System& s, Index k, const Columns* T, const Vec3* B, const Vec3* B_aa, Double4* f,
                                Double4* rim_f) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const std::uint16_t* count = s.tiles.incoming_count.data() + tile.node;
  const Tiles::Incoming* incoming = s.tiles.incoming.data() + tile.incoming;
  const Vec3* B_tile = B + tile.slot;
  const auto received = [&](Index bonds) {
    Double4 sum_0{}, sum_1{}, sum_2{};
    fetch_ahead<1024>(incoming);
    for (const Tiles::Incoming* end = incoming + bonds; incoming != end; ++incoming) {
      const Columns& T_a = T[incoming->from];
      const Vec3& B_ab = B_tile[incoming->slot];
      sum_0 += T_a.c0 * B_ab.x;
      sum_1 += T_a.c1 * B_ab.y;
      sum_2 += T_a.c2 * B_ab.z;
    }
    return sum_0 + sum_1 + sum_2;
  };
  Double4* __restrict f_own = f + tile.begin;
  for (Index a = 0; a < own; ++a) f_own[a] -= received(count[a]) + apply(T[a], B_aa[tile.begin + a]);
  for (Index i = 0; i < rim_size; ++i) rim_f[tile.rim + i] = -received(count[own + i]);
}

void collect_rims(const Tiles& tiles, const Double4* rim_f, Double4* f, Index begin, Index end) {
  const Index* place = tiles.rim_place.data();
  const Offset last = tiles.rim_offset[static_cast<std::size_t>(end)] - 1;
  for (Index a = begin; a < end; ++a) {
    const auto k = static_cast<std::size_t>(a);
    Double4 force = f[a];
    for (Offset i = tiles.rim_offset[k]; i < tiles.rim_offset[k + 1]; ++i) {
      fetch(rim_f + place[std::min(i + 2 * lookahead, last)]);
      force += rim_f[place[i]];
    }
    f[a] = force;
  }
}

}  // namespace tessera
