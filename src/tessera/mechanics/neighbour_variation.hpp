#pragma once

#include "tessera/mechanics/cell_kernel.hpp"

// How F varies in the cells of a tile by its differences to the neighbours (theory, section 11).

namespace tessera {

inline Lanes3 load_centroids(const Double4* C, const std::uint16_t* local) {
  return transposed(C[local[0]], C[local[1]], C[local[2]], C[local[3]]);
}

/// Copies the centroids of the tile and its rim, and brings the matrices of its cells near.
inline void load_centroids_of_tile(const System& s, Index k, Double4* __restrict local) {
  const Tile& tile = tile_of(s, k);
  const Vec3* C = s.d.measure->centroid.data();
  const Mat3* to_points = s.gradients->to_points.data();
  for (Index a = tile.begin; a < tile.end; ++a) {
    fetch(to_points + a);
    fetch_ahead<1024>(C + a);
    local[a - tile.begin] = to_kernel(C[a]);
  }
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const Index* rim = s.tiles.rim.data() + tile.rim;
  for (Index i = 0; i < rim_size; ++i) {
    fetch(C + rim[std::min(i + lookahead, rim_size - 1)]);
    local[own + i] = to_kernel(C[rim[i]]);
  }
}

/// C_ab / r^2 of the bonds of a quad, zero where there is no common face; returns their sums.
inline Lanes3 find_weights(const Double4* C, const std::uint16_t* order, const std::uint16_t* neighbour,
                           const double* area_over_length, Index length, Double4* weights) {
  const Double4 zero{};
  const Lanes3 C_a = load_centroids(C, order);
  Lanes3 sum;
  for (Index i = 0; i < length; ++i, neighbour += quad, area_over_length += quad, weights += quad) {
    const Double4 A_L{area_over_length[0], area_over_length[1], area_over_length[2], area_over_length[3]};
    const Lanes3 C_ab = load_centroids(C, neighbour) - C_a;
    const Double4 square = C_ab.x * C_ab.x + C_ab.y * C_ab.y + C_ab.z * C_ab.z;
    const Lanes3 w = (A_L > zero ? 1.0 / square : zero) * C_ab;
    const FourVectors rows = transposed(w);
    for (Index lane = 0; lane < quad; ++lane) weights[lane] = rows.v[lane];
    sum = sum + w;
  }
  return sum;
}

/// (1/2) sum (F_b - F_a) C_ab,k / r^2, k = 1 to 3, of a particle; bonds are in every fourth slot.
template <class Eight>
inline void sum_differences(const TileNode* nodes, const double* F_a, const std::uint16_t* neighbour,
                            const Double4* weights, Index length, TensorRows& sums) {
  const auto eight_a = load_row<Eight>(F_a);
  Eight k_0{}, k_1{}, k_2{};
  Double4 ninth{};
  for (Index i = 0; i < length; ++i, neighbour += quad, weights += quad) {
    const double* F_b = nodes[*neighbour].value;
    const auto* w = reinterpret_cast<const double*>(weights);
    const Eight difference = load_row<Eight>(F_b) - eight_a;
    add_scaled(k_0, w[0], difference);
    add_scaled(k_1, w[1], difference);
    add_scaled(k_2, w[2], difference);
    ninth += (F_b[8] - F_a[8]) * *weights;
  }
  store_row(sums.value, k_0);
  store_row(sums.value + 8, k_1);
  store_row(sums.value + 16, k_2);
  store_row(sums.value + TensorRows::ninths, ninth);
}

/// A_a of several particles.
template <class Lanes>
struct Matrices {
  Matrices(const Mat3* A, const CellGroup<Lanes>& group) {
    const double* row[lanes_in<Lanes>];
    for (Index lane = 0; lane < lanes_in<Lanes>; ++lane) row[lane] = A[group.local[lane]].m.data();
    const FourOf<Lanes> a = load_fours(row, 0), b = load_fours(row, 4), c = load_fours(row, 5);
    const Lanes entries[3][3] = {{a.n0, a.n1, a.n2}, {a.n3, b.n0, b.n1}, {b.n2, b.n3, c.n3}};
    std::copy(&entries[0][0], &entries[0][0] + 9, &m[0][0]);
  }
  Lanes m[3][3];
};

/// Differences of F to the neighbours.
struct Neighbours {
  const System& s;
  Index tile;
  TileScratch& scratch;

  /// The variation of F in a group of cells by the differences to their neighbours. Groups come one after the other.
  template <class Lanes>
  class Variation {
   public:
    static CellGroup<Lanes> group(const System& s, const Tile& tile, Index first) { return {s, tile, first}; }

    explicit Variation(const Neighbours& source)
        : nodes_(source.scratch.nodes.data()),
          C_(source.scratch.centroid.data()),
          to_points_(source.s.gradients->to_points.data() + tile_of(source.s, source.tile).begin),
          order_(source.s.tiles.order.data() + quad * tile_of(source.s, source.tile).quad),
          length_(source.s.tiles.length.data() + tile_of(source.s, source.tile).quad),
          neighbour_(source.s.tiles.neighbour.data() + tile_of(source.s, source.tile).slot),
          area_over_length_(source.s.tiles.area_over_length.data() + tile_of(source.s, source.tile).slot),
          weights_(source.scratch.gradient_weights.data()),
          moments_(source.scratch.moments.data()),
          quads_(tile_of(source.s, source.tile).quads()) {
      load_centroids_of_tile(source.s, source.tile, source.scratch.centroid.data());
    }

    inline PointStrains<Lanes> find(const CellGroup<Lanes>& group) {
      TensorRows sums[lanes_in<Lanes>];
      const double* row[lanes_in<Lanes>];
      for (Index q = 0; q < group.quads; ++q)
        if (group.first + q < quads_) arrivals_[q] = sum_quad(group.first + q, sums + quad * q);
      for (Index lane = 0; lane < group.lanes; ++lane) row[lane] = sums[std::min(lane, group.count - 1)].value;
      Lanes9Of<Lanes> G[3];
      load_tensors<Lanes>(row, G);
      const Matrices<Lanes> A(to_points_, group);
      const Lanes two = Lanes{} + 2.0;
      PointStrains<Lanes> strains;
      for (int q = 0; q < 3; ++q)
        for (int k = 0; k < 3; ++k) add(strains.E[q], two * A.m[k][q], G[k]);
      return strains;
    }

    /// Keeps V dU/dG and adds what it does to F_a itself to the stress.
    inline void take(const CellGroup<Lanes>& group, const Lanes& volume, const Lanes9Of<Lanes> (&moment)[3],
                     Lanes9Of<Lanes>& stress) {
      const Matrices<Lanes> A(to_points_, group);
      Lanes9Of<Lanes> Z[3], energy[3];
      for (int k = 0; k < 3; ++k)
        for (int q = 0; q < 3; ++q) add(Z[k], A.m[k][q], moment[q]);
      const Lanes3Of<Lanes> arrivals = together();
      add(stress, Lanes{} - arrivals.x, Z[0]);
      add(stress, Lanes{} - arrivals.y, Z[1]);
      add(stress, Lanes{} - arrivals.z, Z[2]);
      for (int k = 0; k < 3; ++k) add(energy[k], volume, Z[k]);
      double* row[lanes_in<Lanes>];
      for (Index lane = 0; lane < group.lanes; ++lane) row[lane] = moments_[group.local[lane]].value;
      store_tensors(energy, row);
    }

   private:
    using Eight = typename EightOf<Lanes>::type;

    inline Lanes3 sum_quad(Index q, TensorRows* sums) {
      const std::uint16_t* order = order_ + quad * q;
      const Index length = length_[q];
      const Lanes3 arrivals = find_weights(C_, order, neighbour_, area_over_length_, length, weights_);
      for (Index lane = 0; lane < quad; ++lane)
        sum_differences<Eight>(nodes_, nodes_[order[lane]].value, neighbour_ + lane, weights_ + lane, length,
                               sums[lane]);
      neighbour_ += quad * length, area_over_length_ += quad * length, weights_ += quad * length;
      return arrivals;
    }

    inline Lanes3Of<Lanes> together() const {
      if constexpr (lanes_in<Lanes> == 4)
        return arrivals_[0];
      else
        return {joined(arrivals_[0].x, arrivals_[1].x), joined(arrivals_[0].y, arrivals_[1].y),
                joined(arrivals_[0].z, arrivals_[1].z)};
    }

    const TileNode* nodes_;
    const Double4* C_;
    const Mat3* to_points_;
    const std::uint16_t *order_, *length_, *neighbour_;
    const double* area_over_length_;
    Double4* weights_;
    TensorRows* moments_;
    Index quads_;
    Lanes3 arrivals_[CellGroup<Lanes>::quads];
  };
};

/// What the moments that Neighbours has kept do to the neighbours' F; leaves the tile's stresses in `stress`.
void return_moments(const CellTask& task, const CellStress& stress, Registers registers);

}  // namespace tessera
