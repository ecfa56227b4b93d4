#include "tessera/mechanics/curved_sweep.hpp"

#include <span>

#include "tessera/mechanics/cell_kernel.hpp"
#include "tessera/mechanics/second_order.hpp"

namespace tessera {

namespace {

constexpr int number_of[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};  // of second derivatives

/// F varies by the cells' second derivatives; where they are not resolved, as is known. Arrays begin with the tile.
struct CurvedStrains {
  const Symmetric3* points;
  const double* inverse_sum;
  const Hessian* weighted;
  Hessian* moments;
  Index begin;                        // of the tile
  std::span<const Index> unresolved;  // of the tile's own cells
  ThreeTensors* strains;              // of those; they become what multiplies them in the energy

  template <class Lanes>
  class Variation {
   public:
    explicit Variation(const CurvedStrains& source) : s_(source) {}

    static CellGroup<Lanes> group(const System& /*s*/, const Tile& tile, Index first) { return {tile, first}; }

    inline PointStrains<Lanes> find(const CellGroup<Lanes>& group) {
      fetch_later(group);
      const double *point[lanes_in<Lanes>], *row[lanes_in<Lanes>];
      for (Index lane = 0; lane < group.lanes; ++lane) {
        point[lane] = &s_.points[group.local[lane]].xx;
        row[lane] = s_.weighted[group.local[lane]].h;
      }
      const FourOf<Lanes> p0 = load_fours(point, 0), p2 = load_fours(point, 2);
      const Lanes share = group(s_.inverse_sum);
      p_[0] = share * p0.n0, p_[1] = share * p0.n1, p_[2] = share * p0.n2;
      p_[3] = share * p0.n3, p_[4] = share * p2.n2, p_[5] = share * p2.n3;
      const FourOf<Lanes> h0 = load_fours(row, 0), h4 = load_fours(row, 4), h8 = load_fours(row, 8),
                          h12 = load_fours(row, 12), h14 = load_fours(row, 14);
      const Lanes h[18] = {h0.n0, h0.n1, h0.n2, h0.n3,  h4.n0,  h4.n1,  h4.n2,  h4.n3,  h8.n0,
                           h8.n1, h8.n2, h8.n3, h12.n0, h12.n1, h12.n2, h12.n3, h14.n2, h14.n3};
      const auto strain = [&](int q) {
        const auto component = [&](int i, int j) {
          return point_of(0, q) * h[3 * number_of[0][j] + i] + point_of(1, q) * h[3 * number_of[1][j] + i] +
                 point_of(2, q) * h[3 * number_of[2][j] + i];
        };
        return Lanes9Of<Lanes>{component(0, 0), component(0, 1), component(0, 2), component(1, 0), component(1, 1),
                               component(1, 2), component(2, 0), component(2, 1), component(2, 2)};
      };
      PointStrains<Lanes> strains{{strain(0), strain(1), strain(2)}};
      for_unresolved(group, [&](Index lane, const ThreeTensors& known) {
        for (int q = 0; q < 3; ++q) {
          const Columns& t = known.k[q];
          Lanes9Of<Lanes>& E = strains.E[q];
          E.xx[lane] = t.c0[0], E.xy[lane] = t.c1[0], E.xz[lane] = t.c2[0];
          E.yx[lane] = t.c0[1], E.yy[lane] = t.c1[1], E.yz[lane] = t.c2[1];
          E.zx[lane] = t.c0[2], E.zy[lane] = t.c1[2], E.zz[lane] = t.c2[2];
        }
      });
      return strains;
    }

    inline void take(const CellGroup<Lanes>& group, const Lanes& volume, const Lanes9Of<Lanes> (&Z)[3],
                     Lanes9Of<Lanes>&) {
      fetch_moments(group);
      Lanes z[3][9];  // row by row
      for (int q = 0; q < 3; ++q) {
        const Lanes numbers[9] = {Z[q].xx, Z[q].xy, Z[q].xz, Z[q].yx, Z[q].yy, Z[q].yz, Z[q].zx, Z[q].zy, Z[q].zz};
        std::copy(numbers, numbers + 9, z[q]);
      }
      Lanes g[18];
      for (int j = 0; j < 3; ++j)
        for (int k = j; k < 3; ++k)
          for (int i = 0; i < 3; ++i) {
            Lanes sum{};
            for (int q = 0; q < 3; ++q) {
              sum += point_of(j, q) * z[q][3 * i + k];
              if (k != j) sum += point_of(k, q) * z[q][3 * i + j];
            }
            g[3 * number_of[j][k] + i] = volume * sum;
          }
      double* row[lanes_in<Lanes>];
      for (Index lane = 0; lane < group.lanes; ++lane) row[lane] = s_.moments[group.local[lane]].h;
      for (int n = 0; n < 16; n += 4) store_fours({g[n], g[n + 1], g[n + 2], g[n + 3]}, row, n);
      store_fours({g[14], g[15], g[16], g[17]}, row, 14);
      for_unresolved(group, [&](Index lane, ThreeTensors& known) {
        for (int q = 0; q < 3; ++q) {
          const auto column = [&](const Lanes& first, const Lanes& second, const Lanes& third) {
            return volume[lane] * Double4{first[lane], second[lane], third[lane], 0.0};
          };
          known.k[q] = {column(Z[q].xx, Z[q].yx, Z[q].zx), column(Z[q].xy, Z[q].yy, Z[q].zy),
                        column(Z[q].xz, Z[q].yz, Z[q].zz)};
        }
      });
    }

   private:
    void fetch_later(const CellGroup<Lanes>& group) const {
      const Index later = quad * group.first + 24;
      for (std::size_t at = 0; at < group.lanes * sizeof(Hessian); at += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(s_.weighted + later) + at);
    }
    void fetch_moments(const CellGroup<Lanes>& group) const {
      const Index later = quad * group.first + 24;
      for (std::size_t at = 0; at < group.lanes * sizeof(Symmetric3); at += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(s_.points + later) + at);
      for (std::size_t at = 0; at < group.lanes * sizeof(Hessian); at += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(s_.moments + later) + at, 1);
    }

    const Lanes& point_of(int k, int q) const { return p_[number_of[k][q]]; }

    /// Calls body(lane, strains) for the lanes whose cells are not resolved.
    template <class Body>
    void for_unresolved(const CellGroup<Lanes>& group, Body&& body) const {
      if (s_.unresolved.empty()) return;
      for (Index lane = 0; lane < group.count; ++lane) {
        const auto at = std::lower_bound(s_.unresolved.begin(), s_.unresolved.end(), s_.begin + group.local[lane]);
        if (at != s_.unresolved.end() && *at == s_.begin + group.local[lane])
          body(lane, s_.strains[at - s_.unresolved.begin()]);
      }
    }

    const CurvedStrains& s_;
    Lanes p_[6];  // distances of points, times inverse_sum
  };
};

TESSERA_CELL_KERNELS(CurvedStrains)

}  // namespace

StressSums curved_stress_sweep(const System& s, Index k, const Tensor* F, const HistorySpan& history,
                               ViscousMemory* viscous, double dt, TileScratch& scratch, SecondOrderMemory& memory,
                               const CellReport& report) {
  const Tile& tile = tile_of(s, k);
  const CellTask task{s, k, F, history, viscous, dt, scratch, report};
  const SecondOrderSystem& c = *s.second_order;
  const auto first = std::lower_bound(c.unresolved.begin(), c.unresolved.end(), tile.begin),
             last = std::lower_bound(first, c.unresolved.end(), tile.end);
  const CurvedStrains source{c.points.data() + tile.begin,
                             c.rows.inverse_sum.data() + tile.begin,
                             memory.weighted.data() + tile.begin,
                             memory.moments.data() + tile.begin,
                             tile.begin,
                             {first, last},
                             memory.unresolved.data() + (first - c.unresolved.begin())};
  [[maybe_unused]] const Registers registers = widest_registers();
  return visit_law(s.materials[static_cast<std::size_t>(tile.material)].law, history.flow,
                   [&](const auto& law) { TESSERA_RUN_CELL_KERNEL(task, law, source, registers); });
}

}  // namespace tessera
