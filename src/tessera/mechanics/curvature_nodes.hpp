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

/// The fourth lane in all.
inline Double4 fourth(const Double4& v) { return __builtin_shufflevector(v, v, 3, 3, 3, 3); }

inline Double4 with_fourth(const Double4& v, double fourth) {
  return __builtin_shufflevector(v, Double4{} + fourth, 0, 1, 2, 7);
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
  RowReader(const System& s, Index k)
      : tile(tile_of(s, k)),
        row(s.second_order->rows.rows.data() + tile.begin),
        neighbour(s.second_order->rows.neighbours.data() + start(s, k).neighbour),
        M(s.second_order->rows.M.data() + start(s, k).face),
        next_M(M),
        map(s.second_order->rows.map[0].data() + map_size * static_cast<Offset>(tile.begin)) {}

  static const CurvatureRows::Start& start(const System& s, Index k) {
    return s.second_order->rows.start[static_cast<std::size_t>(k)];
  }

  /// Calls body(neighbour) for those of the row. With each it fetches a little of what the streams will bring later:
  /// half a line each, as much as a row takes of them.
  template <class Body, class... Stream>
  void for_each_neighbour(Body&& body, const Stream*... stream) {
    for (const CurvatureRows::Neighbour* end = neighbour + row->neighbours; neighbour != end; ++neighbour) {
      (fetch_ahead<4096>(stream), ...);
      ((stream += 4), ...);
      body(*neighbour);
    }
    next_M += row->first_named;
  }

  /// Fetches what will be written for a row of later.
  template <class T>
  static void fetch_result(const T* rows, Index row) {
    for (std::size_t line = 0; line < sizeof(T) + 63; line += 64)
      __builtin_prefetch(reinterpret_cast<const char*>(rows + row + rows_ahead) + line, 1);
  }
  static constexpr Index rows_ahead = 12;

  void next() { ++row, map += map_size; }

  const Tile& tile;
  const CurvatureRows::Row* row;
  const CurvatureRows::Neighbour* neighbour;
  const CurvatureRows::FaceFactors* M;
  const CurvatureRows::FaceFactors* next_M;
  const double* map;

  static constexpr Offset map_size = std::tuple_size_v<SecondDerivatives::Map>;
};

}  // namespace tessera
