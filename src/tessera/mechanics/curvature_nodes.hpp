#pragma once

#include <algorithm>
#include <utility>

#include "tessera/mechanics/hessians.hpp"
#include "tessera/mechanics/tile_nodes.hpp"

// What the sweeps of second derivatives share.

namespace tessera {

constexpr Index derivatives = 6;  // xx, xy, xz, yy, yz, zz

/// Calls body(k) for k = 0 to n - 1, each a constant, so that what it indexes stays in registers.
template <Index n, class Body>
inline void unrolled(Body&& body) {
  const auto call = [&]<Index... k>(std::integer_sequence<Index, k...>) {
    (body(std::integral_constant<Index, k>{}), ...);
  };
  call(std::make_integer_sequence<Index, n>{});
}

/// One lane in all.
template <int lane>
inline Double4 lane_of(const Double4& v) {
  return __builtin_shufflevector(v, v, lane, lane, lane, lane);
}
inline Double4 fourth(const Double4& v) { return lane_of<3>(v); }

/// One number in all lanes.
inline Double4 everywhere(double value) { return Double4{value, value, value, value}; }

inline Double4 with_fourth(const Double4& v, double fourth) {
  return __builtin_shufflevector(v, everywhere(fourth), 0, 1, 2, 7);
}

/// A vector and a zero.
inline Double4 vector_at(const Vec3& v) {
  Double2 first;
  __builtin_memcpy(&first, &v, sizeof first);
  return __builtin_shufflevector(first, Double2{v.z, 0.0}, 0, 1, 2, 3);
}

inline Double4 load4(const double* from) {
  Double4 v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

/// The `n`-th of the vectors that are `numbers` numbers together.
template <Index n, Index numbers>
inline Double4 vector_of(const double* all) {
  if constexpr (3 * n + 4 <= numbers) {
    return load4(all + 3 * n);
  } else {
    const Double4 v = load4(all + 3 * n - 1);
    return __builtin_shufflevector(v, v, 1, 2, 3, 3);
  }
}

/// Columns of a tensor, each with a component of a position.
inline void put_columns(const Tensor& t, const Vec3& X, Double4 (&to)[3]) {
  to[0] = with_fourth(vector_of<0, 9>(t.m), X.x);
  to[1] = with_fourth(vector_of<1, 9>(t.m), X.y);
  to[2] = with_fourth(vector_of<2, 9>(t.m), X.z);
}

inline void put_vectors(const Hessian& H, Double4 (&to)[derivatives]) {
  unrolled<derivatives>([&](auto r) { to[r] = vector_of<r, 3 * derivatives>(H.h); });
}

/// Three lanes each, the first of which are followed by others.
template <Index n>
inline void store_vectors(const Double4 (&v)[n], double* to) {
  unrolled<n - 1>([&](auto r) { __builtin_memcpy(to + 3 * r, &v[r], sizeof(Double4)); });
  __builtin_memcpy(to + 3 * (n - 1), &v[n - 1], 3 * sizeof(double));
}

template <class T>
inline void fetch_all(const T* value) {
  const char* first = reinterpret_cast<const char*>(value);
  for (std::size_t at = 0; at < sizeof(T); at += 64) __builtin_prefetch(first + at);
  __builtin_prefetch(first + sizeof(T) - 1);
}

/// Calls fill(local, particle) for the tile and its rim, and ahead(particle) for what is filled later.
template <class Fill, class Ahead>
inline void for_each_node(const System& s, Index k, Fill&& fill, Ahead&& ahead) {
  const Tile& tile = tile_of(s, k);
  for (Index b = tile.begin; b < tile.end; ++b) fill(b - tile.begin, b);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  for (Index i = 0; i < rim_size; ++i) {
    ahead(rim[std::min(i + lookahead, rim_size - 1)]);
    fill(own + i, rim[i]);
  }
}

/// The rows of a tile, one after the other.
struct RowReader {
  RowReader(const System& s, Index k) : RowReader(s.second_order->rows, tile_of(s, k), k) {}

  RowReader(const CurvatureRows& r, const Tile& of, Index k)
      : tile(of),
        row(r.rows.data() + tile.begin),
        neighbour(r.neighbours.data() + start(r, k).neighbour),
        B(r.B.data() + start(r, k).neighbour + start(r, k).other),
        other(r.others.data() + start(r, k).other),
        far(r.far.data() + start(r, k).far),
        mean(r.means.data() + start(r, k).mean),
        M(r.M.data() + start(r, k).face),
        next_M(M),
        fit(r.fit.data() + tile.begin) {}

  static const CurvatureRows::Start& start(const CurvatureRows& r, Index k) {
    return r.start[static_cast<std::size_t>(k)];
  }

  /// Calls body(neighbour, B) for those of the row. With each it fetches a little of what the streams will bring later:
  /// half a line each, as much as a row takes of them.
  template <class Body, class... Stream>
  void for_each_neighbour(Body&& body, const Stream*... stream) {
    for (const CurvatureRows::Neighbour* end = neighbour + row->neighbours; neighbour != end; ++neighbour, ++B) {
      (fetch_ahead<4096>(stream), ...);
      ((stream += 4), ...);
      body(*neighbour, *B);
    }
    next_M += row->first_named;
  }

  /// Then: calls body(b, B) for the bonds without a face.
  template <class Body>
  void for_each_other(Body&& body) {
    for (const std::uint16_t* end = other + row->others; other != end; ++other, ++B) body(*other, *B);
  }

  /// Calls body(b) for the local numbers that the row's fit takes beyond the neighbours.
  template <class Body>
  void for_each_far(Body&& body) {
    for (const std::uint16_t* end = far + row->far; far != end; ++far) body(*far);
  }

  /// Fetches what will be written for a row of later.
  template <class T>
  static void fetch_result(const T* rows, Index row) {
    for (std::size_t line = 0; line < sizeof(T) + 63; line += 64)
      __builtin_prefetch(reinterpret_cast<const char*>(rows + row + rows_ahead) + line, 1);
  }
  static constexpr Index rows_ahead = 12;

  void next() { mean += row->means, ++row, ++fit; }

  const Tile& tile;
  const CurvatureRows::Row* row;
  const CurvatureRows::Neighbour* neighbour;
  const Vec3* B;
  const std::uint16_t *other, *far;
  const Index* mean;
  const CurvatureRows::FaceFactors* M;
  const CurvatureRows::FaceFactors* next_M;
  const QuadraticFit* fit;
};

}  // namespace tessera
