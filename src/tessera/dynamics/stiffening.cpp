#include "tessera/dynamics/stiffening.hpp"

#include <variant>

#include "tessera/dynamics/vectors.hpp"
#include "tessera/laws/law_lanes.hpp"

namespace tessera {

namespace {

/// Calls body(law, begin, end) for particles of one law.
template <class Body>
void for_each_law(const System& s, Body&& body) {
  for (const MaterialRange& r : s.ranges)
    std::visit([&](const auto& law) { body(law, r.begin, r.end); },
               s.materials[static_cast<std::size_t>(r.material)].law);
}

/// The wave modulus about particle a's deformation and the history of its first stress point.
template <class Law>
double modulus(const Law& law, const Forces& forces, std::int64_t a) {
  const PlasticState* history = forces.plastic().data();
  if (history != nullptr) history += a * forces.stress_points();
  return wave_modulus(law, forces.law_deformation(static_cast<std::size_t>(a)), history);
}

}  // namespace

void Stiffening::remember(const Forces& forces) {
  for_each_law(system_, [&](const auto& law, Index begin, Index end) {
    parallel::for_ranges(begin, end, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t a = first; a < last; ++a) moduli_[static_cast<std::size_t>(a)] = modulus(law, forces, a);
    });
  });
}

double Stiffening::growth(const Forces& forces) const {
  Largest largest;
  for_each_law(system_, [&](const auto& law, Index begin, Index end) {
    largest += Largest{largest_of(end - begin, [&](std::int64_t i) {
      return modulus(law, forces, begin + i) / moduli_[static_cast<std::size_t>(begin + i)];
    })};
  });
  return largest.value;
}

}  // namespace tessera
