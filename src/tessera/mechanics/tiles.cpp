#include "tessera/mechanics/tiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tessera/base/error.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

// Local numbers and positions of bonds have 16 bits.
constexpr Offset most_local = std::numeric_limits<std::uint16_t>::max();
// Tiles enough to keep many threads busy, as long as they do not get too small; the values of a large one and its rim
// take 0.7 MB.
constexpr Index wanted_tiles = 32, smallest = 256, largest = 2048;

Offset padded(Offset bonds) { return (bonds + 3) / 4 * 4; }

/// Ranges of particles whose rims, at worst one particle a bond, can still be numbered.
std::vector<Tile> cut_into_tiles(const Discretization& d, const std::vector<MaterialRange>& ranges, Index size) {
  std::vector<Tile> tiles;
  for (const MaterialRange& r : ranges)
    for (Index a = r.begin; a < r.end;) {
      Tile tile;
      tile.begin = a;
      tile.material = r.material;
      Offset local = 0;
      for (; a < r.end && a < tile.begin + size; ++a) {
        local += 1 + padded(d.bonds.end(a) - d.bonds.begin(a));
        if (local > most_local) break;
      }
      if (a == tile.begin)
        throw GeometryError(fmt::format("particle {} has {} bonds; at most {} can be handled", a,
                                        d.bonds.end(a) - d.bonds.begin(a), most_local - 4));
      tile.end = a;
      tiles.push_back(tile);
    }
  return tiles;
}

std::vector<Index> rim_of(const Discretization& d, const Tile& tile) {
  std::vector<Index> rim;
  for (Offset i = d.bonds.begin(tile.begin); i < d.bonds.end(tile.end - 1); ++i) {
    const Index b = d.bonds.neighbour[static_cast<std::size_t>(i)];
    if (b < tile.begin || b >= tile.end) rim.push_back(b);
  }
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  return rim;
}

/// Places the tiles' data one after the other.
void place(Tiles& t, const Discretization& d, const std::vector<std::vector<Index>>& rims) {
  Tile end;
  for (std::size_t k = 0; k < t.tiles.size(); ++k) {
    Tile& tile = t.tiles[k];
    const Offset rim = static_cast<Offset>(rims[k].size());
    tile.rim = end.rim, tile.bond = end.bond, tile.lane = end.lane, tile.node = end.node, tile.incoming = end.incoming;
    end.rim += rim;
    end.node += tile.size() + rim;
    t.most_particles = std::max(t.most_particles, tile.size());
    t.most_nodes = std::max(t.most_nodes, static_cast<Index>(tile.size() + rim));
    for (Index a = tile.begin; a < tile.end; ++a) {
      const Offset bonds = d.bonds.end(a) - d.bonds.begin(a);
      end.bond += bonds;
      end.lane += padded(bonds);
    }
    end.incoming = end.bond;
  }
  end.begin = end.end = d.particles();
  t.tiles.push_back(end);
  t.bonds = end.bond;
  t.rim.resize(static_cast<std::size_t>(end.rim));
  t.count.resize(d.X.size());
  t.neighbour.resize(static_cast<std::size_t>(end.lane));
  t.area_over_length.resize(static_cast<std::size_t>(end.lane));
  t.B.resize(static_cast<std::size_t>(end.bond));
  if (d.direct) t.direct_B.resize(static_cast<std::size_t>(end.bond));
  t.incoming_count.resize(static_cast<std::size_t>(end.node));
  t.incoming.resize(static_cast<std::size_t>(end.incoming));
}

class TileFiller {
 public:
  TileFiller(Tiles& t, const Discretization& d, const Tile& tile, const std::vector<Index>& rim)
      : t_(t), d_(d), tile_(tile), rim_(rim) {}

  void fill() {
    std::copy(rim_.begin(), rim_.end(), t_.rim.begin() + tile_.rim);
    auto bond = static_cast<std::size_t>(tile_.bond), lane = static_cast<std::size_t>(tile_.lane);
    for (Index a = tile_.begin; a < tile_.end; ++a) {
      const Offset first = d_.bonds.begin(a), last = d_.bonds.end(a);
      t_.count[static_cast<std::size_t>(a)] = static_cast<std::uint16_t>(last - first);
      for (Offset i = first; i < last; ++i, ++bond, ++lane) {
        const auto k = static_cast<std::size_t>(i);
        t_.neighbour[lane] = local(d_.bonds.neighbour[k]);
        t_.area_over_length[lane] = d_.bonds.area_over_length[k];
        t_.B[bond] = d_.bonds.B_ab[k];
        if (d_.direct)
          t_.direct_B[bond] = d_.direct->B_ba[static_cast<std::size_t>(d_.bonds.find(d_.bonds.neighbour[k], a))];
      }
      for (Offset i = last; i < first + padded(last - first); ++i, ++lane) {
        t_.neighbour[lane] = t_.neighbour[lane - 1];
        t_.area_over_length[lane] = 0.0;
      }
    }
    turn_round();
  }

 private:
  std::uint16_t local(Index b) const {
    if (b >= tile_.begin && b < tile_.end) return static_cast<std::uint16_t>(b - tile_.begin);
    return static_cast<std::uint16_t>(tile_.size() + (std::lower_bound(rim_.begin(), rim_.end(), b) - rim_.begin()));
  }

  /// Sorts the tile's bonds by where they lead.
  void turn_round() {
    std::uint16_t* count = t_.incoming_count.data() + tile_.node;
    const std::size_t nodes = static_cast<std::size_t>(tile_.size()) + rim_.size();
    std::vector<Offset> next(nodes + 1, 0);
    const auto for_each_bond = [&](auto&& body) {
      const std::uint16_t* neighbour = t_.neighbour.data() + tile_.lane;
      Offset bond = 0;
      for (Index a = 0; a < tile_.size(); ++a) {
        const Offset bonds = t_.count[static_cast<std::size_t>(tile_.begin + a)];
        for (Offset i = 0; i < bonds; ++i) body(static_cast<std::uint16_t>(a), neighbour[i], bond++);
        neighbour += padded(bonds);
      }
    };
    for_each_bond([&](std::uint16_t, std::uint16_t b, Offset) { ++next[b + std::size_t{1}]; });
    for (std::size_t k = 0; k < nodes; ++k) {
      count[k] = static_cast<std::uint16_t>(next[k + 1]);
      next[k + 1] += next[k];
    }
    Tiles::Incoming* incoming = t_.incoming.data() + tile_.incoming;
    for_each_bond([&](std::uint16_t a, std::uint16_t b, Offset bond) {
      incoming[next[b]++] = {a, static_cast<std::uint16_t>(bond)};
    });
  }

  Tiles& t_;
  const Discretization& d_;
  const Tile& tile_;
  const std::vector<Index>& rim_;
};

void find_rim_places(Tiles& t, Index particles) {
  t.rim_offset.assign(static_cast<std::size_t>(particles) + 1, 0);
  for (Index a : t.rim) ++t.rim_offset[static_cast<std::size_t>(a) + 1];
  for (std::size_t a = 0; a < static_cast<std::size_t>(particles); ++a) t.rim_offset[a + 1] += t.rim_offset[a];
  std::vector<Offset> next(t.rim_offset.begin(), t.rim_offset.end() - 1);
  t.rim_place.resize(t.rim.size());
  for (std::size_t k = 0; k < t.rim.size(); ++k)
    t.rim_place[static_cast<std::size_t>(next[static_cast<std::size_t>(t.rim[k])]++)] = static_cast<Index>(k);
}

}  // namespace

Index tile_size(Index particles) { return std::clamp((particles / wanted_tiles + 63) / 64 * 64, smallest, largest); }

Tiles make_tiles(const Discretization& d, const std::vector<MaterialRange>& ranges, Index size) {
  Tiles t;
  t.tiles = cut_into_tiles(d, ranges, size);
  std::vector<std::vector<Index>> rims(t.tiles.size());
  const auto tiles = static_cast<std::int64_t>(t.tiles.size());
  parallel::for_tasks(tiles, [&](std::int64_t k) {
    rims[static_cast<std::size_t>(k)] = rim_of(d, t.tiles[static_cast<std::size_t>(k)]);
  });
  place(t, d, rims);
  parallel::for_tasks(tiles, [&](std::int64_t k) {
    TileFiller(t, d, t.tiles[static_cast<std::size_t>(k)], rims[static_cast<std::size_t>(k)]).fill();
  });
  find_rim_places(t, d.particles());
  return t;
}

}  // namespace tessera
