#include "tessera/dynamics/stiffening.hpp"

#include <algorithm>
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
  smallest_J_ = forces.sums().smallest_J;
  for_each_law(system_, [&](const auto& law, Index begin, Index end) {
    parallel::for_ranges(begin, end, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t a = first; a < last; ++a) moduli_[static_cast<std::size_t>(a)] = modulus(law, forces, a);
    });
  });
}

double Stiffening::growth(const Forces& forces) const {
  const double means = growth_of_means(forces);
  if (forces.stress_points() == 1) return means;
  const double others = static_cast<double>(forces.stress_points() - 1);
  return std::max(means, (others * means + growth_when_squeezed(forces.sums().smallest_J)) / (others + 1.0));
}

/// Of a point squeezed in one direction from the smallest J that is remembered to this one, the largest of all laws.
double Stiffening::growth_when_squeezed(double J) const {
  double growth = 0.0;
  const PlasticState untouched;
  for (const Material& m : system_.materials)
    growth = std::max(growth, std::visit(
                                  [&](const auto& law) {
                                    return wave_modulus(law, diagonal(J, 1, 1), &untouched) /
                                           wave_modulus(law, diagonal(smallest_J_, 1, 1), &untouched);
                                  },
                                  m.law));
  return growth;
}

double Stiffening::growth_of_means(const Forces& forces) const {
  Largest largest;
  for_each_law(system_, [&](const auto& law, Index begin, Index end) {
    largest += Largest{largest_of(end - begin, [&](std::int64_t i) {
      return modulus(law, forces, begin + i) / moduli_[static_cast<std::size_t>(begin + i)];
    })};
  });
  return largest.value;
}

}  // namespace tessera
