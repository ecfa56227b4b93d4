#pragma once

namespace tessera {

/// Four numbers in one register. Alone it holds the components of a vector and a zero; in a Lanes3 or Lanes9 the same
/// component of four vectors or tensors. Arrays of it are Fields: the compiler takes its alignment for granted.
using Double4 = double __attribute__((vector_size(32)));

/// The same in registers of 512 bits, for kernels that know they have them.
using Double8 = double __attribute__((vector_size(64)));
using Double2 = double __attribute__((vector_size(16)));

/// How many numbers lanes hold.
template <class Lanes>
constexpr int lanes_in = sizeof(Lanes) / sizeof(double);

/// Several vectors, component by component.
template <class Lanes>
struct Lanes3Of {
  Lanes x{}, y{}, z{};
};
using Lanes3 = Lanes3Of<Double4>;

/// Several tensors, component by component; rc is row r, column c.
template <class Lanes>
struct Lanes9Of {
  Lanes xx{}, xy{}, xz{}, yx{}, yy{}, yz{}, zx{}, zy{}, zz{};
};
using Lanes9 = Lanes9Of<Double4>;

template <class Lanes>
inline Lanes3Of<Lanes> operator+(const Lanes3Of<Lanes>& a, const Lanes3Of<Lanes>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Lanes>
inline Lanes3Of<Lanes> operator-(const Lanes3Of<Lanes>& a, const Lanes3Of<Lanes>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Lanes>
inline Lanes3Of<Lanes> operator*(const Lanes& s, const Lanes3Of<Lanes>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

inline double sum(const Double4& v) { return (v[0] + v[1]) + (v[2] + v[3]); }

inline Double8 joined(const Double4& first, const Double4& second) {
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}
inline Double4 first_half(const Double8& l) { return __builtin_shufflevector(l, l, 0, 1, 2, 3); }
inline Double4 second_half(const Double8& l) { return __builtin_shufflevector(l, l, 4, 5, 6, 7); }

/// From four vectors (x, y, z, anything) to their components.
inline Lanes3 transposed(const Double4& v0, const Double4& v1, const Double4& v2, const Double4& v3) {
  const Double4 xz01 = __builtin_shufflevector(v0, v1, 0, 4, 2, 6), xz23 = __builtin_shufflevector(v2, v3, 0, 4, 2, 6);
  const Double4 y01 = __builtin_shufflevector(v0, v1, 1, 5, 3, 7), y23 = __builtin_shufflevector(v2, v3, 1, 5, 3, 7);
  return {__builtin_shufflevector(xz01, xz23, 0, 1, 4, 5), __builtin_shufflevector(y01, y23, 0, 1, 4, 5),
          __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7)};
}

/// From the components of four vectors to the vectors, each with a zero at the end.
struct FourVectors {
  Double4 v[4];
};
inline FourVectors transposed(const Lanes3& l) {
  const Double4 zero{};
  const Double4 xy02 = __builtin_shufflevector(l.x, l.y, 0, 4, 2, 6),
                xy13 = __builtin_shufflevector(l.x, l.y, 1, 5, 3, 7);
  const Double4 z02 = __builtin_shufflevector(l.z, zero, 0, 4, 2, 6),
                z13 = __builtin_shufflevector(l.z, zero, 1, 5, 3, 7);
  return {{__builtin_shufflevector(xy02, z02, 0, 1, 4, 5), __builtin_shufflevector(xy13, z13, 0, 1, 4, 5),
           __builtin_shufflevector(xy02, z02, 2, 3, 6, 7), __builtin_shufflevector(xy13, z13, 2, 3, 6, 7)}};
}

/// Two consecutive numbers of four rows, the first of each and the second of each.
struct TwoLanes {
  Double4 first, second;
};
inline TwoLanes load_pairs(const double* row0, const double* row1, const double* row2, const double* row3) {
  const auto load = [](const double* row) {
    Double2 pair;
    __builtin_memcpy(&pair, row, sizeof pair);
    return pair;
  };
  const Double4 rows02 = __builtin_shufflevector(load(row0), load(row2), 0, 1, 2, 3),
                rows13 = __builtin_shufflevector(load(row1), load(row3), 0, 1, 2, 3);
  return {__builtin_shufflevector(rows02, rows13, 0, 4, 2, 6), __builtin_shufflevector(rows02, rows13, 1, 5, 3, 7)};
}

/// Four consecutive numbers of several rows: the first of each, the second of each, and so on.
template <class Lanes>
struct FourOf {
  Lanes n0, n1, n2, n3;
};
using FourOfEight = FourOf<Double8>;
/// `k`: of the first number in its row.
inline FourOf<Double4> load_fours(const double* const (&row)[4], int k) {
  const TwoLanes first = load_pairs(row[0] + k, row[1] + k, row[2] + k, row[3] + k),
                 second = load_pairs(row[0] + k + 2, row[1] + k + 2, row[2] + k + 2, row[3] + k + 2);
  return {first.first, first.second, second.first, second.second};
}
/// `rows02`: four numbers of row 0, then four of row 2.
inline FourOfEight transposed_halves(const Double8& rows02, const Double8& rows13, const Double8& rows46,
                                     const Double8& rows57) {
  const Double8 even0 = __builtin_shufflevector(rows02, rows13, 0, 8, 2, 10, 4, 12, 6, 14),
                odd0 = __builtin_shufflevector(rows02, rows13, 1, 9, 3, 11, 5, 13, 7, 15),
                even4 = __builtin_shufflevector(rows46, rows57, 0, 8, 2, 10, 4, 12, 6, 14),
                odd4 = __builtin_shufflevector(rows46, rows57, 1, 9, 3, 11, 5, 13, 7, 15);
  return {__builtin_shufflevector(even0, even4, 0, 1, 4, 5, 8, 9, 12, 13),
          __builtin_shufflevector(odd0, odd4, 0, 1, 4, 5, 8, 9, 12, 13),
          __builtin_shufflevector(even0, even4, 2, 3, 6, 7, 10, 11, 14, 15),
          __builtin_shufflevector(odd0, odd4, 2, 3, 6, 7, 10, 11, 14, 15)};
}
inline FourOfEight load_fours(const double* const (&row)[8], int k) {
  const auto both = [&](int low, int high) {
    Double4 l, h;
    __builtin_memcpy(&l, row[low] + k, sizeof l);
    __builtin_memcpy(&h, row[high] + k, sizeof h);
    return joined(l, h);
  };
  return transposed_halves(both(0, 2), both(1, 3), both(4, 6), both(5, 7));
}

/// The other way.
inline void store_fours(const FourOf<Double4>& l, double* const (&row)[4], int k) {
  const Double4 a02 = __builtin_shufflevector(l.n0, l.n1, 0, 4, 2, 6),
                a13 = __builtin_shufflevector(l.n0, l.n1, 1, 5, 3, 7);
  const Double4 b02 = __builtin_shufflevector(l.n2, l.n3, 0, 4, 2, 6),
                b13 = __builtin_shufflevector(l.n2, l.n3, 1, 5, 3, 7);
  const Double4 rows[4] = {__builtin_shufflevector(a02, b02, 0, 1, 4, 5), __builtin_shufflevector(a13, b13, 0, 1, 4, 5),
                           __builtin_shufflevector(a02, b02, 2, 3, 6, 7),
                           __builtin_shufflevector(a13, b13, 2, 3, 6, 7)};
  for (int i = 0; i < 4; ++i) __builtin_memcpy(row[i] + k, &rows[i], sizeof rows[i]);
}
inline void store_fours(const FourOfEight& l, double* const (&row)[8], int k) {
  const Double8 a = __builtin_shufflevector(l.n0, l.n1, 0, 8, 2, 10, 4, 12, 6, 14),
                b = __builtin_shufflevector(l.n0, l.n1, 1, 9, 3, 11, 5, 13, 7, 15),
                c = __builtin_shufflevector(l.n2, l.n3, 0, 8, 2, 10, 4, 12, 6, 14),
                d = __builtin_shufflevector(l.n2, l.n3, 1, 9, 3, 11, 5, 13, 7, 15);
  const Double8 rows[4] = {__builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15),
                           __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (int i = 0; i < 4; ++i) {
    const Double4 first = first_half(rows[i]), second = second_half(rows[i]);
    __builtin_memcpy(row[i] + k, &first, sizeof first);
    __builtin_memcpy(row[i + 4] + k, &second, sizeof second);
  }
}

/// The bit patterns of several numbers.
template <class Lanes>
struct BitsOf;
template <>
struct BitsOf<Double4> {
  using type = unsigned long long __attribute__((vector_size(32)));
};
template <>
struct BitsOf<Double8> {
  using type = unsigned long long __attribute__((vector_size(64)));
};

/// Natural logarithms of positive, finite, normal numbers, to one unit in the last place; of others the result has no
/// meaning. With x = 2^k (1 + f), 1 + f between 1/sqrt 2 and sqrt 2, and s = f / (2 + f), the series of ln((1+s)/(1-s))
/// in s is fitted by a polynomial whose coefficients are those of Sun's fdlibm.
template <class Lanes>
inline Lanes log_of(const Lanes& x) {
  using Bits = typename BitsOf<Lanes>::type;
  constexpr unsigned long long root_half = 0x3FE6A09E667F3BCDULL, bias = 1024, two52_bits = 0x4330000000000000ULL;
  constexpr double two52 = 0x1p52;
  const Bits bits = reinterpret_cast<Bits>(x);
  const Bits biased = (bits - root_half + (bias << 52U)) >> 52U;  // k + bias
  const Lanes k = reinterpret_cast<Lanes>(biased | two52_bits) - (two52 + static_cast<double>(bias));
  const Lanes f = reinterpret_cast<Lanes>(bits - ((biased - bias) << 52U)) - 1.0;
  const Lanes s = f / (2.0 + f), z = s * s, w = z * z;
  const Lanes even = w * (0.3999999999940941908 + w * (0.2222219843214978396 + w * 0.1531383769920937332));
  const Lanes odd = z * (0.6666666666666735130 +
                         w * (0.2857142874366239149 + w * (0.1818357216161805012 + w * 0.1479819860511658591)));
  const Lanes half_square = 0.5 * f * f;
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  return k * ln2_high - ((half_square - (s * (half_square + (even + odd)) + k * ln2_low)) - f);
}
inline Double4 log(const Double4& x) { return log_of(x); }
inline Double8 log(const Double8& x) { return log_of(x); }

/// Exponentials of numbers between -700 and 700, to one unit in the last place; of others the result has no meaning.
/// With x = k ln 2 + r, |r| at most ln(2)/2, it is 2^k times the Taylor polynomial of exp(r).
template <class Lanes>
inline Lanes exp_of(const Lanes& x) {
  using Bits = typename BitsOf<Lanes>::type;
  constexpr double shift = 0x1.8p52;  // adding it rounds to whole numbers, which then are the lowest bits
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  const Lanes shifted = x * 1.44269504088896338700 + shift, k = shifted - shift;
  const Lanes r = (x - k * ln2_high) - k * ln2_low;
  constexpr double inverse_factorial[] = {1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0,
                                          1.0 / 362880.0,     1.0 / 40320.0,     1.0 / 5040.0,     1.0 / 720.0,
                                          1.0 / 120.0,        1.0 / 24.0,        1.0 / 6.0,        0.5};
  Lanes sum = Lanes{} + inverse_factorial[0];
  for (int i = 1; i < 12; ++i) sum = sum * r + inverse_factorial[i];
  const Lanes power = 1.0 + (r + r * r * sum);
  return reinterpret_cast<Lanes>(reinterpret_cast<Bits>(power) + (reinterpret_cast<Bits>(shifted) << 52U));
}
inline Double4 exp(const Double4& x) { return exp_of(x); }
inline Double8 exp(const Double8& x) { return exp_of(x); }

}  // namespace tessera
