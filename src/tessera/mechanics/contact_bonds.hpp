#pragma once

#include "tessera/base/lanes.hpp"
#include "tessera/mechanics/sweeps.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

#ifdef TESSERA_WIDE_KERNEL
#include <immintrin.h>
#endif

// Bonds of several particles at once, one of each: four in registers of 256 bits, eight in those of 512.

namespace tessera {

template <class Lanes>
struct Nodes {
  Lanes3Of<Lanes> F0, F1, F2;  // the columns of F/2
  Lanes3Of<Lanes> x, X;
};

/// Sums over the bonds of each particle.
template <class Lanes>
struct BondSums {
  Lanes3Of<Lanes> force;                         // sum dU/dx
  Lanes3Of<Lanes> moment_0, moment_1, moment_2;  // the columns of - sum dU/dy (x) X
  Lanes energy{};                                // twice the bonds' energies
};

struct ContactStiffness {
  double tangential, difference;  // Kt and Kn - Kt per area over length [Pa]
};

/// Adds a bond of each particle to the sums; the same as bond_response().
template <class Lanes>
inline void add_bonds(const Nodes<Lanes>& a, const Nodes<Lanes>& b, const Lanes& area_over_length,
                      ContactStiffness stiffness, BondSums<Lanes>& sums) {
  using V = Lanes3Of<Lanes>;
  const V X = b.X - a.X, x = b.x - a.x;
  const V F0 = a.F0 + b.F0, F1 = a.F1 + b.F1, F2 = a.F2 + b.F2;
  const V u{x.x - F0.x * X.x - F1.x * X.y - F2.x * X.z, x.y - F0.y * X.x - F1.y * X.y - F2.y * X.z,
            x.z - F0.z * X.x - F1.z * X.y - F2.z * X.z};  // [D 7]
  const Lanes inverse_square = 1.0 / (x.x * x.x + x.y * x.y + x.z * x.z);
  const Lanes p = (u.x * x.x + u.y * x.y + u.z * x.z) * inverse_square;  // u^n = p x_ab, [D 10]
  const Lanes K = area_over_length * stiffness.tangential, q = (area_over_length * stiffness.difference) * p;
  const V elastic{K * u.x + q * x.x, K * u.y + q * x.y, K * u.z + q * x.z};  // -dU/dy, [D 58]
  const auto add_moment = [&](V& column, const Lanes& X_j) {
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
  sums.energy += elastic.x * u.x + elastic.y * u.y + elastic.z * u.z;
}

inline Nodes<Double4> load_nodes(const TileNode* nodes, const std::uint16_t* local) {
  const double *n0 = nodes[local[0]].value, *n1 = nodes[local[1]].value, *n2 = nodes[local[2]].value,
               *n3 = nodes[local[3]].value;
  const auto pairs = [&](int k) { return load_pairs(n0 + k, n1 + k, n2 + k, n3 + k); };
  const TwoLanes p0 = pairs(0), p2 = pairs(2), p4 = pairs(4), p6 = pairs(6), p8 = pairs(8), p10 = pairs(10),
                 p12 = pairs(12), p14 = pairs(14);
  return {{p0.first, p0.second, p2.first},
          {p2.second, p4.first, p4.second},
          {p6.first, p6.second, p8.first},
          {p8.second, p10.first, p10.second},
          {p12.first, p12.second, p14.first}};
}

#ifdef TESSERA_WIDE_KERNEL

/// Two halves, each on a boundary of 32 bytes. The second is inserted by the load, where compilers take a shuffle more
/// to join registers; shuffles are what limits the contact sweep. (A mask of ones is none; without it gcc warns of its
/// own header.)
TESSERA_WIDE_INLINE Double8 load_halves(const double* low, const double* high) {
  return reinterpret_cast<Double8>(
      _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_load_pd(low)), _mm256_load_pd(high), 1));
}
TESSERA_WIDE_INLINE FourOfEight load_aligned_fours(const double* const (&row)[8], int k) {
  return transposed_halves(load_halves(row[0] + k, row[2] + k), load_halves(row[1] + k, row[3] + k),
                           load_halves(row[4] + k, row[6] + k), load_halves(row[5] + k, row[7] + k));
}

TESSERA_WIDE_INLINE Nodes<Double8> load_nodes(const TileNode* nodes, const std::uint16_t* first,
                                              const std::uint16_t* second) {
  const double* const row[8] = {nodes[first[0]].value,  nodes[first[1]].value,  nodes[first[2]].value,
                                nodes[first[3]].value,  nodes[second[0]].value, nodes[second[1]].value,
                                nodes[second[2]].value, nodes[second[3]].value};
  const FourOfEight f0 = load_aligned_fours(row, 0), f4 = load_aligned_fours(row, 4), f8 = load_aligned_fours(row, 8),
                    f12 = load_aligned_fours(row, 12);
  return {{f0.n0, f0.n1, f0.n2},
          {f0.n3, f4.n0, f4.n1},
          {f4.n2, f4.n3, f8.n0},
          {f8.n1, f8.n2, f8.n3},
          {f12.n0, f12.n1, f12.n2}};
}

#endif

}  // namespace tessera
