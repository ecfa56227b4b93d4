#include "tessera/mechanics/sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/laws/law_lanes.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// One binary serves several instruction sets: the loader picks the clone. Sanitizers start before it can.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__OPTIMIZE_SIZE__) && defined(__OPTIMIZE__)
#define TESSERA_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), flatten))
#else
#define TESSERA_KERNEL
#endif

namespace tessera {

namespace {

// How far ahead values of the rim are fetched: their addresses jump, so the processor cannot foresee them.
constexpr Index lookahead = 8;
// How far ahead gradient vectors are fetched, about four particles: the processor's own prefetcher stops at pages.
constexpr Index bytes_ahead = 1536;

template <class T>
inline void fetch(const T* value) {
  const char* first = reinterpret_cast<const char*>(value);
  __builtin_prefetch(first);
  if constexpr (sizeof(T) > 64) __builtin_prefetch(first + sizeof(T) - 1);
}

inline const Tile& tile_of(const System& s, Index tile) { return s.tiles.tiles[static_cast<std::size_t>(tile)]; }

inline Columns minus_half(const Columns& F) { return {-0.5 * F.c0, -0.5 * F.c1, -0.5 * F.c2}; }

// Arrays larger than this are not in the cache when they are read again [bytes].
constexpr std::size_t largest_cached = std::size_t{16} << 20U;

/// Writes a tensor; past the cache the processor need not fetch first what is overwritten.
inline void store(Columns& to, const Columns& value, bool past_the_cache) {
#if defined(__SSE2__)
  if (past_the_cache) {
    auto* numbers = reinterpret_cast<double*>(&to);
    const Double4* columns = &value.c0;
    for (int c = 0; c < 3; ++c) {
      _mm_stream_pd(numbers + 4 * c, __builtin_shufflevector(columns[c], columns[c], 0, 1));
      _mm_stream_pd(numbers + 4 * c + 2, __builtin_shufflevector(columns[c], columns[c], 2, 3));
    }
    return;
  }
#else
  static_cast<void>(past_the_cache);
#endif
  to = value;
}

/// Makes what was written past the cache visible to other threads.
inline void fence() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

}  // namespace

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
      T(static_cast<std::size_t>(s.tiles.most_particles)) {}

TESSERA_KERNEL void strain_sweep(const System& s, Index k, const Double4* x, Columns* F, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  Double4* __restrict x_local = scratch.x.data();
  for (Index a = 0; a < own; ++a) x_local[a] = x[tile.begin + a];
  for (Index i = 0; i < rim_size; ++i) {
    fetch(x + rim[std::min(i + lookahead, rim_size - 1)]);
    x_local[own + i] = x[rim[i]];
  }
  const std::uint16_t* count = s.tiles.count.data() + tile.begin;
  const std::uint16_t* neighbour = s.tiles.neighbour.data() + tile.lane;
  const Vec3* B = s.tiles.B.data() + tile.bond;
  const double* volume = s.d.volume.data() + tile.begin;
  Columns* __restrict F_own = F + tile.begin;
  const bool past_the_cache = s.d.X.size() * sizeof(Columns) > largest_cached;
  for (Index a = 0; a < own; ++a) {
    const Double4 x_a = x_local[a];
    Columns VF{};
    const Index bonds = count[a];
    for (Index i = 0; i < bonds; ++i) {
      __builtin_prefetch(reinterpret_cast<const char*>(B + i) + bytes_ahead);
      add_outer(VF, x_local[neighbour[i]] - x_a, B[i]);
    }
    neighbour += (bonds + 3) / 4 * 4;
    B += bonds;
    store(F_own[a], (1.0 / volume[a]) * VF, past_the_cache);
  }
  if (past_the_cache) fence();
}

namespace {

/// Sums over the bonds of one particle, four bonds at a time; the same as bond_response().
struct BondSums {
  Lanes3 force;                         // - sum dU/dx
  Lanes3 moment_0, moment_1, moment_2;  // the columns of - sum dU/dy (x) X
};

struct ContactStiffness {
  double tangential, difference;  // Kt and Kn - Kt per area over length [Pa]
};

/// Adds four bonds of particle a to the sums and returns their energies times two. Branches are taken from the
/// neighbour to a: that turns the signs of u and of the forces, and leaves the moments.
inline Double4 add_bonds(const TileNode& a, const TileNode* nodes, const std::uint16_t* neighbour,
                         const Double4& area_over_length, ContactStiffness stiffness, BondSums& sums) {
  const TileNode &b0 = nodes[neighbour[0]], &b1 = nodes[neighbour[1]], &b2 = nodes[neighbour[2]],
                 &b3 = nodes[neighbour[3]];
  const auto difference = [&](Double4 TileNode::*v) {
    return transposed(a.*v - b0.*v, a.*v - b1.*v, a.*v - b2.*v, a.*v - b3.*v);
  };
  const auto minus_mean = [&](Double4 Columns::*c) {
    const Double4 F = a.minus_half_F.*c;
    return transposed(F + b0.minus_half_F.*c, F + b1.minus_half_F.*c, F + b2.minus_half_F.*c, F + b3.minus_half_F.*c);
  };
  const Lanes3 X = difference(&TileNode::X), x = difference(&TileNode::x);
  const Lanes3 F0 = minus_mean(&Columns::c0), F1 = minus_mean(&Columns::c1), F2 = minus_mean(&Columns::c2);
  const Lanes3 u{x.x + F0.x * X.x + F1.x * X.y + F2.x * X.z, x.y + F0.y * X.x + F1.y * X.y + F2.y * X.z,
                 x.z + F0.z * X.x + F1.z * X.y + F2.z * X.z};  // [D 7]
  const Double4 inverse_square = 1.0 / (x.x * x.x + x.y * x.y + x.z * x.z);
  const Double4 p = (u.x * x.x + u.y * x.y + u.z * x.z) * inverse_square;  // u^n = p x_ab, [D 10]
  const Double4 K = area_over_length * stiffness.tangential, q = (area_over_length * stiffness.difference) * p;
  const Lanes3 elastic{K * u.x + q * x.x, K * u.y + q * x.y, K * u.z + q * x.z};  // -dU/dy, [D 58]
  const auto add_moment = [&](Lanes3& column, const Double4& X_j) {
    column.x += elastic.x * X_j;
    column.y += elastic.y * X_j;
    column.z += elastic.z * X_j;
  };
  add_moment(sums.moment_0, X.x);
  add_moment(sums.moment_1, X.y);
  add_moment(sums.moment_2, X.z);
  sums.force.x += elastic.x + q * (u.x - p * x.x);  // dU/dx, [D 57]
  sums.force.y += elastic.y + q * (u.y - p * x.y);
  sums.force.z += elastic.z + q * (u.z - p * x.z);
  return elastic.x * u.x + elastic.y * u.y + elastic.z * u.z;
}

inline void load_nodes(const System& s, Index k, const Double4* x, const Columns* F, TileNode* __restrict nodes) {
  const Tile& tile = tile_of(s, k);
  const Vec3* X = s.d.X.data();
  const auto load = [&](TileNode& node, Index b) {
    node = {x[b], Double4{X[b].x, X[b].y, X[b].z, 0.0}, minus_half(F[b])};
  };
  for (Index b = tile.begin; b < tile.end; ++b) load(nodes[b - tile.begin], b);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  for (Index i = 0; i < rim_size; ++i) {
    const Index ahead = rim[std::min(i + lookahead, rim_size - 1)];
    fetch(F + ahead);
    fetch(x + ahead);
    fetch(X + ahead);
    load(nodes[own + i], rim[i]);
  }
}

}  // namespace

TESSERA_KERNEL double contact_sweep(const System& s, Index k, const Double4* x, const Columns* F, Double4* f,
                                    TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  load_nodes(s, k, x, F, scratch.nodes.data());
  const Material& m = s.materials[static_cast<std::size_t>(tile.material)];
  const double Kn = m.contact.normal * m.young, Kt = m.contact.tangential * m.shear_modulus();
  const ContactStiffness stiffness{Kt, Kn - Kt};
  const TileNode* nodes = scratch.nodes.data();
  Columns* __restrict T = scratch.T.data();
  Double4* __restrict f_own = f + tile.begin;
  const std::uint16_t* count = s.tiles.count.data() + tile.begin;
  const std::uint16_t* neighbour = s.tiles.neighbour.data() + tile.lane;
  const double* area_over_length = s.tiles.area_over_length.data() + tile.lane;
  const double* volume = s.d.volume.data() + tile.begin;
  // The next sweep reads the gradient vectors of the tile in another order, so they are brought near.
  const char* B = reinterpret_cast<const char*>(s.tiles.B.data() + tile.bond);
  Double4 energy{};
  for (Index a = 0; a < tile.size(); ++a) {
    const TileNode node = nodes[a];
    BondSums sums;
    for (Index groups = (count[a] + 3) / 4; groups > 0; --groups, neighbour += 4, area_over_length += 4, B += 96) {
      __builtin_prefetch(B);
      __builtin_prefetch(B + 64);
      const Double4 A_L{area_over_length[0], area_over_length[1], area_over_length[2], area_over_length[3]};
      energy += add_bonds(node, nodes, neighbour, A_L, stiffness, sums);
    }
    f_own[a] = -sum(sums.force);
    const double share = -0.5 / volume[a];
    T[a] = {share * sum(sums.moment_0), share * sum(sums.moment_1), share * sum(sums.moment_2)};
  }
  return 0.25 * sum(energy);
}

namespace {

inline Lanes9 to_lanes(const Columns& a, const Columns& b, const Columns& c, const Columns& d) {
  const Lanes3 c0 = transposed(a.c0, b.c0, c.c0, d.c0), c1 = transposed(a.c1, b.c1, c.c1, d.c1),
               c2 = transposed(a.c2, b.c2, c.c2, d.c2);
  return {c0.x, c1.x, c2.x, c0.y, c1.y, c2.y, c0.z, c1.z, c2.z};
}

/// Tensor k of four.
inline Columns columns_of(const Lanes9& t, int k) {
  return {Double4{t.xx[k], t.yx[k], t.zx[k], 0.0}, Double4{t.xy[k], t.yy[k], t.zy[k], 0.0},
          Double4{t.xz[k], t.yz[k], t.zz[k], 0.0}};
}

/// Adds the viscous stress of particle a, [D 61, 62], to P; returns the work that it has taken since the last time [J].
inline double add_viscous_stress(const System& s, Index a, const Columns& F, ViscousMemory& viscous, double dt,
                                 Columns& P) {
  const auto k = static_cast<std::size_t>(a);
  const Mat3 F_a = to_mat3(F), dF = F_a - to_mat3(viscous.F_previous[k]);
  const Mat3 P_viscous = viscous_stress(s.viscosity[k], F_a, (1.0 / dt) * dF);
  const double work = 0.5 * s.d.volume[k] * contract(P_viscous + to_mat3(viscous.P_previous[k]), dF);
  viscous.P_previous[k] = to_kernel(P_viscous);
  P = P + viscous.P_previous[k];
  return work;
}

template <class Law>
inline StressSums stress_of(const System& s, const Tile& tile, const Law& law, const Columns* F,
                            const HistorySpan& history, ViscousMemory* viscous, double dt, TileScratch& scratch) {
  const double* volume = s.d.volume.data();
  Columns* __restrict T = scratch.T.data();
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
      if (scratch.P.empty())
        T[local] = T[local] + P;
      else
        scratch.P[static_cast<std::size_t>(local)] = P;
    }
  }
  sums.smallest_J = std::min(std::min(smallest_J[0], smallest_J[1]), std::min(smallest_J[2], smallest_J[3]));
  sums.finite = std::isfinite(sum(not_finite));
  return sums;
}

// One clone of each law for every instruction set.
#define TESSERA_STRESS_KERNEL(Law)                                                                             \
  TESSERA_KERNEL StressSums stress_kernel(const System& s, const Tile& tile, const Law& law, const Columns* F, \
                                          const HistorySpan& history, ViscousMemory* viscous, double dt,       \
                                          TileScratch& scratch) {                                              \
    return stress_of(s, tile, law, F, history, viscous, dt, scratch);                                          \
  }
TESSERA_STRESS_KERNEL(NeoHookean)
TESSERA_STRESS_KERNEL(SaintVenantKirchhoff)
TESSERA_STRESS_KERNEL(MooneyRivlin)
TESSERA_STRESS_KERNEL(Ogden)
TESSERA_STRESS_KERNEL(J2Plasticity)
#undef TESSERA_STRESS_KERNEL

}  // namespace

StressSums stress_sweep(const System& s, Index k, const Columns* F, const HistorySpan& history, ViscousMemory* viscous,
                        double dt, TileScratch& scratch) {
  const Tile& tile = tile_of(s, k);
  const auto sweep = [&](const auto& law) { return stress_kernel(s, tile, law, F, history, viscous, dt, scratch); };
  return std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.held(); })
          return sweep(history.flow == Flow::held ? law.held() : law);
        else
          return sweep(law);
      },
      s.materials[static_cast<std::size_t>(tile.material)].law);
}

TESSERA_KERNEL void force_sweep(const System& s, Index k, const Columns* T, const Vec3* B, const Vec3* B_aa, Double4* f,
                                Double4* rim_f) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const std::uint16_t* count = s.tiles.incoming_count.data() + tile.node;
  const Tiles::Incoming* incoming = s.tiles.incoming.data() + tile.incoming;
  const Vec3* B_tile = B + tile.bond;
  const auto received = [&](Index bonds) {
    Double4 sum_0{}, sum_1{}, sum_2{};
    for (const Tiles::Incoming* end = incoming + bonds; incoming != end; ++incoming) {
      const Columns& T_a = T[incoming->from];
      const Vec3& B_ab = B_tile[incoming->bond];
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
  for (Index a = begin; a < end; ++a) {
    const auto k = static_cast<std::size_t>(a);
    for (Offset i = tiles.rim_offset[k]; i < tiles.rim_offset[k + 1]; ++i)
      f[a] += rim_f[tiles.rim_place[static_cast<std::size_t>(i)]];
  }
}

}  // namespace tessera
