#include "tessera/mechanics/neighbour_variation.hpp"

namespace tessera {

namespace {

TESSERA_CELL_KERNELS(Neighbours)

/// The sums of a receiver of moments.
template <class Eight>
struct ReceivedRows {
  Eight k_0{}, k_1{}, k_2{};
  Double4 ninth{};

  Eight eight() const { return k_0 + k_1 + k_2; }
  double last() const { return ninth[0] + ninth[1] + ninth[2]; }
};

template <class Eight>
inline void return_moments(const System& s, Index k, const TileScratch& scratch, const CellStress& stress) {
  const Tile& tile = tile_of(s, k);
  const Index own = tile.size(), rim_size = s.tiles.rim_size(k);
  const std::uint16_t* count = s.tiles.incoming_count.data() + tile.node;
  const Tiles::Incoming* incoming = s.tiles.incoming.data() + tile.incoming;
  const TensorRows* moments = scratch.moments.data();
  const Double4* weights = scratch.gradient_weights.data();
  const auto receive = [&](Index bonds) {
    fetch_ahead<1024>(incoming);
    ReceivedRows<Eight> received;
    for (const Tiles::Incoming* end = incoming + bonds; incoming != end; ++incoming) {
      const double* Z = moments[incoming->from].value;
      const Double4& weight = weights[incoming->slot];
      const auto* w = reinterpret_cast<const double*>(&weight);
      add_scaled(received.k_0, w[0], load_row<Eight>(Z));
      add_scaled(received.k_1, w[1], load_row<Eight>(Z + 8));
      add_scaled(received.k_2, w[2], load_row<Eight>(Z + 16));
      received.ninth += weight * load_row<Double4>(Z + TensorRows::ninths);
    }
    return received;
  };
  const double* volume = s.d.volume.data() + tile.begin;
  const Columns* T = scratch.P.empty() ? scratch.T.data() : scratch.P.data();
  Tensor* __restrict to = stress.own + tile.begin, * __restrict rim = stress.rim + tile.rim;
  for (Index a = 0; a < own; ++a) {
    const ReceivedRows<Eight> sum = receive(count[a]);
    const double share = 1.0 / volume[a];
    auto eight = eight_of<Eight>(T[a].c0, T[a].c1, T[a].c2);
    add_scaled(eight, share, sum.eight());
    fetch_to_write<512>(to + a);
    store_row(to[a].m, eight);
    to[a].m[8] = T[a].c2[2] + share * sum.last();
  }
  for (Index i = 0; i < rim_size; ++i) {
    const ReceivedRows<Eight> sum = receive(count[own + i]);
    fetch_to_write<512>(rim + i);
    store_row(rim[i].m, sum.eight());
    rim[i].m[8] = sum.last();
  }
}

/// What the moments of the tile's own stresses do to F_b: sum_a Z_a C_ab / r^2 of the bonds that lead to b, [J].
TESSERA_KERNEL void return_moments_of_four(const System& s, Index k, const TileScratch& scratch,
                                           const CellStress& stress) {
  return_moments<TwoFours>(s, k, scratch, stress);
}

#ifdef TESSERA_WIDE_KERNEL
TESSERA_WIDE_KERNEL void return_moments_of_eight(const System& s, Index k, const TileScratch& scratch,
                                                 const CellStress& stress) {
  return_moments<Double8>(s, k, scratch, stress);
}
#endif

/// The gradient vectors of a tile, fetched a few lines with each of its particles.
class LinesOfTile {
 public:
  LinesOfTile(const System& s, Index k)
      : first_(reinterpret_cast<const char*>(s.tiles.B.data() + tile_of(s, k).slot)),
        lines_((s.tiles.end_of(k).slot - tile_of(s, k).slot) * static_cast<Offset>(sizeof(Vec3)) / line /
                   std::max<Index>(tile_of(s, k).size(), 1) +
               1) {}

  void fetch(Index particle) const {
    const char* B = first_ + particle * lines_ * line;
    for (Offset i = 0; i < lines_; ++i) __builtin_prefetch(B + line * i);
  }

 private:
  static constexpr Offset line = 64;
  const char* first_;
  Offset lines_;  // for each particle
};

StressSums run(const CellTask& task, const CellStress& stress, [[maybe_unused]] Registers registers) {
  const Material& m = task.s.materials[static_cast<std::size_t>(tile_of(task.s, task.tile).material)];
  const Neighbours source{task.s, task.tile, task.scratch};
  const StressSums sums = visit_law(m.law, task.history.flow,
                                    [&](const auto& law) { TESSERA_RUN_CELL_KERNEL(task, law, source, registers); });
  return_moments(task, stress, registers);
  return sums;
}

}  // namespace

void return_moments(const CellTask& task, const CellStress& stress, [[maybe_unused]] Registers registers) {
#ifdef TESSERA_WIDE_KERNEL
  if (registers == Registers::eight_numbers) {
    return_moments_of_eight(task.s, task.tile, task.scratch, stress);
    return;
  }
#endif
  return_moments_of_four(task.s, task.tile, task.scratch, stress);
}

StressSums cell_stress_sweep(const System& s, Index k, const Tensor* F, const HistorySpan& history,
                             ViscousMemory* viscous, double dt, TileScratch& scratch, const CellStress& stress,
                             const CellReport& report, const Tensor* at_centroids) {
  return run({s, k, F, history, viscous, dt, scratch, report, at_centroids}, stress, widest_registers());
}

StressSums cell_stress_sweep_of_four(const System& s, Index k, const Tensor* F, const HistorySpan& history,
                                     ViscousMemory* viscous, double dt, TileScratch& scratch, const CellStress& stress,
                                     const CellReport& report) {
  return run({s, k, F, history, viscous, dt, scratch, report}, stress, Registers::four_numbers);
}

void load_tile(const System& s, Index k, const Double4* x, const Tensor* F, TileScratch& scratch) {
  fill_nodes(s, k, x, F, scratch.nodes.data());
}

TESSERA_KERNEL void complete_stresses(const System& s, Index k, const Tensor* own, const Tensor* rims,
                                      Columns* __restrict T) {
  const Tile& tile = tile_of(s, k);
  const Index size = tile.size();
  const Offset* offset = s.tiles.rim_offset.data() + tile.begin;
  const Index* place = s.tiles.rim_place.data();
  const double* volume = s.d.volume.data() + tile.begin;
  const Offset last = s.tiles.rim_offset.back() - 1;
  const LinesOfTile B(s, k);
  own += tile.begin;
  for (Index a = 0; a < size; ++a) {
    B.fetch(a);
    Columns sum{};
    for (Offset i = offset[a]; i < offset[a + 1]; ++i) {
      fetch(rims + place[std::min(i + 2 * lookahead, last)]);
      sum = sum + to_kernel(rims[place[i]]);
    }
    T[a] = to_kernel(own[a]) + (1.0 / volume[a]) * sum;
  }
}

}  // namespace tessera
