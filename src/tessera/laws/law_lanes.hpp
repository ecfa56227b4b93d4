#pragma once

#include "tessera/laws/j2_plasticity.hpp"
#include "tessera/laws/mooney_rivlin_lanes.hpp"
#include "tessera/laws/neo_hookean_lanes.hpp"
#include "tessera/laws/saint_venant_kirchhoff_lanes.hpp"

namespace tessera {

/// A law whose answer depends on what has happened to the stress point.
template <class Law>
concept HasHistory = requires(const Law& law, const Mat3& F, const PlasticState& before) {
  law.response(F, before);
};

/// A law with a form for several deformations at once.
template <class Law>
concept InLanes = requires(const Law& law, const Lanes9& F) {
  response(law, F);
};

/// Law::response() of several deformations, one after the other: for laws that have no form for several at once.
template <class Law, class Lanes>
inline LanesResponseOf<Lanes> one_by_one(const Law& law, const Lanes9Of<Lanes>& F,
                                         const LanesHistoryOf<Lanes>& history) {
  LanesResponseOf<Lanes> all{};
  for (int k = 0; k < lanes_in<Lanes>; ++k) {
    const Mat3 F_k = tensor_of(F, k);
    const auto i = static_cast<std::size_t>(k);
    all.J[k] = determinant(F_k);
    if constexpr (HasHistory<Law>) {
      const auto answer = law.response(F_k, *history.before[i]);
      all.energy[k] = answer.energy;
      all.dissipated[k] = answer.dissipated;
      set_tensor(all.stress, k, answer.stress);
      if (history.after[i] != nullptr) *history.after[i] = answer.after;
    } else {
      const auto answer = law.response(F_k);
      all.energy[k] = answer.energy;
      set_tensor(all.stress, k, answer.stress);
    }
  }
  return all;
}

/// Any law's answer to several deformations at once. Where J is not positive energy and stress have no meaning.
template <class Law, class Lanes>
inline LanesResponseOf<Lanes> response(const Law& law, const Lanes9Of<Lanes>& F, const LanesHistoryOf<Lanes>& history) {
  if constexpr (InLanes<Law>)
    return response(law, F);
  else
    return one_by_one(law, F, history);
}

/// Bound of rho c^2 over all plane waves about F [Pa], of a law with or without history; flow is held.
template <class Law>
inline double wave_modulus(const Law& law, const Mat3& F, const PlasticState* history) {
  if constexpr (HasHistory<Law>)
    return law.wave_modulus(F, *history);
  else
    return law.wave_modulus(F);
}

/// Stored energy per reference volume [J/m3] of a law with or without history.
template <class Law>
inline double stored_energy(const Law& law, const Mat3& F, const PlasticState* history) {
  if constexpr (HasHistory<Law>)
    return law.response(F, *history).energy;
  else
    return law.energy(F);
}

}  // namespace tessera

// Write KERNEL(Law, ...) for every law, or for those that are InLanes: what is compiled once for each of them.
#define TESSERA_FOR_EACH_LAW_IN_LANES(KERNEL, ...)        \
  KERNEL(NeoHookean __VA_OPT__(, ) __VA_ARGS__)           \
  KERNEL(SaintVenantKirchhoff __VA_OPT__(, ) __VA_ARGS__) \
  KERNEL(MooneyRivlin __VA_OPT__(, ) __VA_ARGS__)
#define TESSERA_FOR_EACH_LAW(KERNEL, ...)                          \
  TESSERA_FOR_EACH_LAW_IN_LANES(KERNEL __VA_OPT__(, ) __VA_ARGS__) \
  KERNEL(Ogden __VA_OPT__(, ) __VA_ARGS__)                         \
  KERNEL(J2Plasticity __VA_OPT__(, ) __VA_ARGS__)
