#pragma once

#include <algorithm>

#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// The rows of F'_a = (1/V_a) sum_b (x_b - x_a) (x) B'_ab: the gradient that is exact for linear motion and that
/// particles alone determine, at prescribed faces too.
class FirstDerivatives {
 public:
  FirstDerivatives(const Discretization& d, const SecondOrder& s) : d_(d), s_(s) {}

  /// Calls body(b, B) for the terms of row a; a particle may come several times.
  template <class Body>
  void for_each_term(Index a, Body&& body) const {
    for (Offset i = d_.bonds.begin(a); i < d_.bonds.end(a); ++i)
      body(d_.bonds.neighbour[static_cast<std::size_t>(i)], d_.bonds.B_ab[static_cast<std::size_t>(i)]);
    for_each_held(a, [&](std::size_t k) {
      for (const FaceTerm& t : s_.extrapolated.row(static_cast<Index>(k)))
        if (t.particle != a) body(t.particle, t.weight * s_.held[k].area);
    });
  }

  /// Calls body(k) for the held faces of a.
  template <class Body>
  void for_each_held(Index a, Body&& body) const {
    const auto is_before = [](const HeldFace& f, Index owner) { return f.owner < owner; };
    for (auto f = std::lower_bound(s_.held.begin(), s_.held.end(), a, is_before); f != s_.held.end() && f->owner == a;
         ++f)
      body(static_cast<std::size_t>(f - s_.held.begin()));
  }

  /// Calls body(b) for the neighbours with a common face.
  template <class Body>
  void for_each_neighbour(Index a, Body&& body) const {
    for (Offset i = d_.bonds.begin(a); i < d_.bonds.end(a); ++i)
      if (d_.bonds.area_over_length[static_cast<std::size_t>(i)] > 0.0)
        body(d_.bonds.neighbour[static_cast<std::size_t>(i)]);
  }

 private:
  const Discretization& d_;
  const SecondOrder& s_;
};

}  // namespace tessera
