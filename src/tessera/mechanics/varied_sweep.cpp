#include "tessera/mechanics/cell_kernel.hpp"

namespace tessera {

namespace {

/// A variation that is known.
struct KnownStrains {
  const ThreeTensors* E;
  ThreeTensors* Z;

  template <class Lanes>
  class Variation {
   public:
    explicit Variation(const KnownStrains& source) : E_(source.E), Z_(source.Z) {}

    inline void find(const CellGroup<Lanes>& group, Lanes9Of<Lanes> (&E)[3]) {
      const double* row[lanes_in<Lanes>];
      for (Index lane = 0; lane < group.lanes; ++lane)
        row[lane] = reinterpret_cast<const double*>(E_ + group.local[lane]);
      for (int q = 0; q < 3; ++q) {
        const FourOf<Lanes> c0 = load_fours(row, 12 * q), c1 = load_fours(row, 12 * q + 4),
                            c2 = load_fours(row, 12 * q + 8);
        E[q] = {c0.n0, c1.n0, c2.n0, c0.n1, c1.n1, c2.n1, c0.n2, c1.n2, c2.n2};
      }
    }
    inline void take(const CellGroup<Lanes>& group, const Lanes& volume, const Lanes9Of<Lanes> (&moment)[3],
                     Lanes9Of<Lanes>&) {
      for (int k = 0; k < 3; ++k) {
        Lanes9Of<Lanes> scaled;
        add(scaled, volume, moment[k]);
        const ColumnsOf<Lanes> columns(scaled);
        for (Index lane = 0; lane < group.count; ++lane) Z_[group.local[lane]].k[k] = columns.t[lane];
      }
    }

   private:
    const ThreeTensors* E_;
    ThreeTensors* Z_;
  };
};

TESSERA_CELL_KERNELS(KnownStrains)

}  // namespace

StressSums varied_stress_sweep(const System& s, Index k, const Tensor* F, const ThreeTensors* E,
                               const HistorySpan& history, ViscousMemory* viscous, double dt, TileScratch& scratch,
                               ThreeTensors* Z, const CellReport& report) {
  const Tile& tile = tile_of(s, k);
  const CellTask task{s, k, F, history, viscous, dt, scratch, report};
  const KnownStrains source{E + tile.begin, Z + tile.begin};
  const Registers registers = widest_registers();
  return visit_law(s.materials[static_cast<std::size_t>(tile.material)].law, history.flow,
                   [&](const auto& law) { TESSERA_RUN_CELL_KERNEL(task, law, source, registers); });
}

}  // namespace tessera
