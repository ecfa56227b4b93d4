#pragma once

#include <type_traits>

#include "tessera/base/lanes.hpp"

// Tensors of single particles as rows of numbers: a bond works on eight of them at once, in one register of 512 bits or
// two of 256, and several rows become lanes where laws want them.

namespace tessera {

/// Eight numbers in registers of 256 bits.
struct TwoFours {
  Double4 low{}, high{};
};
inline TwoFours operator-(const TwoFours& a, const TwoFours& b) { return {a.low - b.low, a.high - b.high}; }
inline TwoFours operator+(const TwoFours& a, const TwoFours& b) { return {a.low + b.low, a.high + b.high}; }
inline void add_scaled(TwoFours& sum, double s, const TwoFours& t) {
  sum.low += s * t.low;
  sum.high += s * t.high;
}
inline void add_scaled(Double8& sum, double s, const Double8& t) { sum += s * t; }

/// The type of eight numbers that goes with lanes.
template <class Lanes>
struct EightOf;
template <>
struct EightOf<Double4> {
  using type = TwoFours;
};
template <>
struct EightOf<Double8> {
  using type = Double8;
};

template <class Row>
inline Row load_row(const double* from) {
  Row row;
  __builtin_memcpy(static_cast<void*>(&row), from, sizeof row);
  return row;
}
template <class Row>
inline void store_row(double* to, const Row& row) {
  __builtin_memcpy(to, &row, sizeof row);
}

/// The first eight numbers of three columns of three.
template <class Eight>
inline Eight eight_of(const Double4& c0, const Double4& c1, const Double4& c2) {
  const TwoFours eight{__builtin_shufflevector(c0, c1, 0, 1, 2, 4), __builtin_shufflevector(c1, c2, 1, 2, 4, 5)};
  if constexpr (std::is_same_v<Eight, Double8>)
    return joined(eight.low, eight.high);
  else
    return eight;
}

/// Three tensors, column by column: the first eight numbers of each, then the ninth of each and a zero.
struct alignas(64) TensorRows {
  static constexpr int eight = 8, ninths = 24;
  double value[32];
};

/// Three tensors of each of several particles, from their rows to lanes.
template <class Lanes>
inline void load_tensors(const double* const (&row)[lanes_in<Lanes>], Lanes9Of<Lanes> (&t)[3]) {
  const FourOf<Lanes> ninth = load_fours(row, TensorRows::ninths);
  const Lanes last[3] = {ninth.n0, ninth.n1, ninth.n2};
  for (int k = 0; k < 3; ++k) {
    const FourOf<Lanes> l = load_fours(row, TensorRows::eight * k), h = load_fours(row, TensorRows::eight * k + 4);
    t[k] = {l.n0, l.n3, h.n2, l.n1, h.n0, h.n3, l.n2, h.n1, last[k]};
  }
}

/// From lanes to rows.
template <class Lanes>
inline void store_tensors(const Lanes9Of<Lanes> (&t)[3], double* const (&row)[lanes_in<Lanes>]) {
  for (int k = 0; k < 3; ++k) {
    store_fours({t[k].xx, t[k].yx, t[k].zx, t[k].xy}, row, TensorRows::eight * k);
    store_fours({t[k].yy, t[k].zy, t[k].xz, t[k].yz}, row, TensorRows::eight * k + 4);
  }
  store_fours({t[0].zz, t[1].zz, t[2].zz, Lanes{}}, row, TensorRows::ninths);
}

}  // namespace tessera
