#include "tessera/dynamics/stiffening.hpp"

#include <variant>

#include "tessera/dynamics/vectors.hpp"

namespace tessera {

namespace {

/// Calls body(law, begin, end) for particles of one law.
template <class Body>
void for_each_law(const System& s, Body&& body) {
  for (const MaterialRange& r : s.ranges)
    std::visit([&](const auto& law) { body(law, r.begin, r.end); },
               s.materials[static_cast<std::size_t>(r.material)].law);
}

}  // namespace

void Stiffening::remember(const Field<Columns>& F) {
  for_each_law(system_, [&](const auto& law, Index begin, Index end) {
    parallel::for_ranges(begin, end, [&](std::int64_t first, std::int64_t last) {
      for (auto a = static_cast<std::size_t>(first); a < static_cast<std::size_t>(last); ++a)
        moduli_[a] = law.wave_modulus(to_mat3(F[a]));
    });
  });
}

double Stiffening::growth(const Field<Columns>& F) const {
  Largest largest;
  for_each_law(system_, [&](const auto& law, Index begin, Index end) {
    largest += Largest{largest_of(end - begin, [&](std::int64_t i) {
      const auto a = static_cast<std::size_t>(begin + i);
      return law.wave_modulus(to_mat3(F[a])) / moduli_[a];
    })};
  });
  return largest.value;
}

}  // namespace tessera
