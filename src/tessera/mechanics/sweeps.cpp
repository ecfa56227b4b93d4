#include "tessera/mechanics/sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "tessera/laws/neo_hookean.hpp"

// One binary serves several instruction sets: the loader picks the clone. Sanitizers start before it can.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__OPTIMIZE_SIZE__) && defined(__OPTIMIZE__)
#define TESSERA_KERNEL __attribute__((target_clones("arch=x86-64-v3", "default"), flatten))
#else
#define TESSERA_KERNEL
#endif

namespace tessera {

namespace {

// How many bonds ahead the values of neighbours are fetched: their addresses jump, so the processor cannot foresee
// them.
constexpr Offset lookahead = 24;

template <class T>
inline void fetch(const T* values, Index b) {
  const char* first = reinterpret_cast<const char*>(values + b);
  __builtin_prefetch(first);
  if constexpr (sizeof(T) > 64) __builtin_prefetch(first + sizeof(T) - 1);
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

TESSERA_KERNEL void strain_sweep(const System& s, const Double4* x, Columns* F, Index begin, Index end) {
  const Offset* offset = s.d.bonds.offset.data();
  const Index* neighbour = s.d.bonds.neighbour.data();
  const Vec3* B_ab = s.d.bonds.B_ab.data();
  const Offset last = s.d.bonds.size() - 1;
  for (Index a = begin; a < end; ++a) {
    const Double4 x_a = x[a];
    Columns VF{};
    for (Offset i = offset[a]; i < offset[a + 1]; ++i) {
      fetch(x, neighbour[std::min(i + lookahead, last)]);
      add_outer(VF, x[neighbour[i]] - x_a, B_ab[i]);
    }
    F[a] = (1.0 / s.d.volume[static_cast<std::size_t>(a)]) * VF;
  }
}

TESSERA_KERNEL void force_sweep(const Bonds& bonds, const Vec3* B_ba, const Vec3* B_aa, const Columns* T, Double4* f,
                                Index begin, Index end) {
  const Offset* offset = bonds.offset.data();
  const Index* neighbour = bonds.neighbour.data();
  const Offset last = bonds.size() - 1;
  for (Index a = begin; a < end; ++a) {
    Double4 sum = apply(T[a], B_aa[a]);
    for (Offset i = offset[a]; i < offset[a + 1]; ++i) {
      fetch(T, neighbour[std::min(i + lookahead, last)]);
      sum += apply(T[neighbour[i]], B_ba[i]);
    }
    f[a] -= sum;
  }
}

namespace {

/// Sums over the bonds of one particle, in the layout of the sweeps; the same as bond_response().
struct BondSums {
  double energy = 0.0;  // half of each bond's
  Double4 force{};      // sum dU/dx
  Columns moment{};     // - sum dU/dy (x) X
};

/// a . b / c . d of vectors with a zero in the fourth place.
inline double ratio_of_products(const Double4& a, const Double4& b, const Double4& c, const Double4& d) {
  using Mask = long long __attribute__((vector_size(32)));
  const Double4 p = a * b, q = c * d;
  const Double4 t = __builtin_shuffle(p, q, Mask{0, 4, 2, 6}) + __builtin_shuffle(p, q, Mask{1, 5, 3, 7});
  return (t[0] + t[2]) / (t[1] + t[3]);
}

inline BondSums sum_bonds(const System& s, const Double4* x, const Columns* F, double stiffness_n, double stiffness_t,
                          Index a) {
  const Bonds& bonds = s.d.bonds;
  const Index* neighbour = bonds.neighbour.data();
  const Vec3* X_ref = s.d.X.data();
  const double* area_over_length = bonds.area_over_length.data();
  const double stiffness_difference = stiffness_n - stiffness_t;
  const Double4 x_a = x[a];
  const Vec3 X_a = X_ref[a];
  const Columns F_a = F[a];
  BondSums sums;
  Double4 energy{};
  const Offset end = bonds.offset[static_cast<std::size_t>(a) + 1], last = bonds.size() - 1;
  for (Offset i = bonds.offset[static_cast<std::size_t>(a)]; i < end; ++i) {
    const Index b = neighbour[i], ahead = neighbour[std::min(i + lookahead, last)];
    fetch(F, ahead);
    fetch(x, ahead);
    fetch(X_ref, ahead);
    const Vec3 X = X_ref[b] - X_a;
    const Double4 x_ab = x[b] - x_a;
    const Double4 u = x_ab - 0.5 * apply(F_a + F[b], X);      // [D 7]
    const double p = ratio_of_products(u, x_ab, x_ab, x_ab);  // u^n = p x_ab, [D 10]
    const double q = stiffness_difference * p;
    const Double4 u_t = u - p * x_ab;
    const Double4 elastic = stiffness_t * u + q * x_ab;       // -dU/dy per A/L, [D 58]
    sums.force += area_over_length[i] * (elastic + q * u_t);  // dU/dx, [D 57]
    const Double4 scaled = area_over_length[i] * elastic;
    add_outer(sums.moment, scaled, X);
    energy += scaled * u;
  }
  sums.energy = 0.25 * (energy[0] + energy[1] + energy[2]);
  return sums;
}

/// P of one particle: elastic part, then the viscous one if there is any.
template <class Law>
inline Mat3 particle_stress(const StressSweep& w, const Law& law, Index a, const Mat3& F, double J, StressSums& sums) {
  const double V = w.s.d.volume[static_cast<std::size_t>(a)];
  sums.smallest_J = std::min(sums.smallest_J, J);
  sums.finite = sums.finite && std::isfinite(J);
  const auto response = law.response(F);
  sums.internal += V * response.energy;
  Mat3 P = response.stress;
  if (w.viscous != nullptr && w.dt > 0.0) {
    const auto k = static_cast<std::size_t>(a);
    const Mat3 dF = F - to_mat3(w.viscous->F_previous[k]);
    const Mat3 P_viscous = viscous_stress(w.s.viscosity[k], F, (1.0 / w.dt) * dF);
    sums.dissipated += 0.5 * V * contract(P_viscous + to_mat3(w.viscous->P_previous[k]), dF);
    w.viscous->P_previous[k] = to_kernel(P_viscous);
    P += P_viscous;
  }
  return P;
}

template <class Law>
inline StressSums stress_range(const StressSweep& w, const Law& law, double stiffness_n, double stiffness_t,
                               Index begin, Index end) {
  StressSums sums;
  for (Index a = begin; a < end; ++a) {
    const Mat3 F = to_mat3(w.F[a]);
    const Columns P = to_kernel(particle_stress(w, law, a, F, determinant(F), sums));
    const BondSums bonds = sum_bonds(w.s, w.x, w.F, stiffness_n, stiffness_t, a);
    const Columns Q = (-0.5 / w.s.d.volume[static_cast<std::size_t>(a)]) * bonds.moment;
    if (w.P != nullptr) {
      w.P[a] = P;
      w.T[a] = Q;
    } else {
      w.T[a] = P + Q;
    }
    w.f[a] = bonds.force;
    sums.contact += bonds.energy;
  }
  return sums;
}

TESSERA_KERNEL StressSums stress_of(const StressSweep& w, const NeoHookean& law, double stiffness_n, double stiffness_t,
                                    Index begin, Index end) {
  return stress_range(w, law, stiffness_n, stiffness_t, begin, end);
}

}  // namespace

StressSums StressSweep::operator()(const Material& m, Index begin, Index end) const {
  const double stiffness_n = m.contact.normal * m.young, stiffness_t = m.contact.tangential * m.shear_modulus();
  return std::visit([&](const auto& law) { return stress_of(*this, law, stiffness_n, stiffness_t, begin, end); },
                    m.law);
}

}  // namespace tessera
