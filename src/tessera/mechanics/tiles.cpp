#include "tessera/mechanics/tiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/parallel/parallel.hpp"

namespace tessera {

namespace {

// Local numbers and slots have 16 bits.
constexpr Offset most_local = std::numeric_limits<std::uint16_t>::max();
// Tiles enough to keep many threads busy, as long as they do not get too small; what a pass over a large one touches
// takes 1.2 MB.
constexpr Index wanted_tiles = 32, smallest = 256, largest = 1024;
// Particles that are sorted by their number of bonds; more would spread neighbours over the cache.
constexpr Index window = 64;

Offset bonds_of(const Discretization& d, Index a) { return d.bonds.end(a) - d.bonds.begin(a); }

/// The particles of a window, fewest bonds first.
std::vector<Index> sorted_window(const Discretization& d, Index begin, Index end) {
  std::vector<Index> particles(static_cast<std::size_t>(end - begin));
  std::iota(particles.begin(), particles.end(), begin);
  std::stable_sort(particles.begin(), particles.end(),
                   [&](Index a, Index b) { return bonds_of(d, a) < bonds_of(d, b); });
  return particles;
}

/// Four times the bonds of every fourth particle and of the last.
Offset slots_of(const Discretization& d, std::span<const Index> sorted) {
  Offset slots = 0;
  for (std::size_t k = 0; k < sorted.size(); k += 4)
    slots += 4 * bonds_of(d, sorted[std::min(k + 3, sorted.size() - 1)]);
  return slots;
}

/// Particles beyond the bonds that second derivatives follow.
std::span<const Index> far_of(const Discretization& d, Index a) {
  if (!d.second_order) return {};
  return d.second_order->derivatives.far.row(a);
}

/// The number of particles from a on, at most `wanted`, that can be numbered together, with rims that at worst hold a
/// particle a slot and all that are far; and how many those are.
std::pair<Index, Offset> next_window(const Discretization& d, Index a, Index wanted, Offset numbers_left) {
  for (Index size = wanted; size > 0; size /= 2) {
    Offset most = slots_of(d, sorted_window(d, a, a + size));
    for (Index b = a; b < a + size; ++b) most += static_cast<Offset>(far_of(d, b).size());
    if (size + most <= numbers_left) return {size, most};
  }
  return {0, 0};
}

/// Ranges of particles, each windows of equal size but for the last.
std::vector<Tile> cut_into_tiles(const Discretization& d, const std::vector<MaterialRange>& ranges, Index size) {
  std::vector<Tile> tiles;
  for (const MaterialRange& r : ranges)
    for (Index a = r.begin; a < r.end;) {
      Tile tile;
      tile.begin = a;
      tile.material = r.material;
      Offset numbers_left = most_local;
      for (Index wanted = window; wanted == window && a < std::min(r.end, tile.begin + size);) {
        wanted = std::min({window, r.end - a, tile.begin + size - a});
        const auto [taken, most] = next_window(d, a, wanted, numbers_left);
        a += taken;
        numbers_left -= taken + most;
        if (taken < window) break;
      }
      if (a == tile.begin)
        throw GeometryError(fmt::format("particle {} has {} bonds; at most {} can be handled", a, bonds_of(d, a),
                                        (most_local - 1) / 4));
      tile.end = a;
      tiles.push_back(tile);
    }
  return tiles;
}

/// Particles of a tile window by window, filled up to quads.
std::vector<Index> order_of(const Discretization& d, const Tile& tile) {
  std::vector<Index> order;
  for (Index a = tile.begin; a < tile.end; a += window) {
    const std::vector<Index> sorted = sorted_window(d, a, std::min(a + window, tile.end));
    order.insert(order.end(), sorted.begin(), sorted.end());
  }
  order.resize(static_cast<std::size_t>(4 * tile.quads()), order.back());
  return order;
}

std::vector<Index> rim_of(const Discretization& d, const Tile& tile) {
  std::vector<Index> rim;
  const auto add = [&](Index b) {
    if (b < tile.begin || b >= tile.end) rim.push_back(b);
  };
  for (Offset i = d.bonds.begin(tile.begin); i < d.bonds.end(tile.end - 1); ++i)
    add(d.bonds.neighbour[static_cast<std::size_t>(i)]);
  for (Index a = tile.begin; a < tile.end; ++a)
    for (const Index b : far_of(d, a)) add(b);
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  return rim;
}

/// What is found out about a tile before there are arrays to put it into.
struct TilePlan {
  std::vector<Index> rim, order;
  Offset slots = 0;
};

TilePlan plan(const Discretization& d, const Tile& tile) {
  TilePlan p{rim_of(d, tile), order_of(d, tile), 0};
  p.slots = slots_of(d, p.order);
  return p;
}

/// Places the tiles' data one after the other.
void place(Tiles& t, const Discretization& d, const std::vector<TilePlan>& plans) {
  Tile end;
  for (std::size_t k = 0; k < t.tiles.size(); ++k) {
    Tile& tile = t.tiles[k];
    const Offset rim = static_cast<Offset>(plans[k].rim.size());
    tile.rim = end.rim, tile.quad = end.quad, tile.slot = end.slot, tile.node = end.node, tile.incoming = end.incoming;
    end.rim += rim;
    end.quad += tile.quads();
    end.slot += plans[k].slots;
    end.node += tile.size() + rim;
    end.incoming += d.bonds.end(tile.end - 1) - d.bonds.begin(tile.begin);
    t.most_particles = std::max(t.most_particles, tile.size());
    t.most_nodes = std::max(t.most_nodes, static_cast<Index>(tile.size() + rim));
  }
  end.begin = end.end = d.particles();
  t.tiles.push_back(end);
  t.bonds = end.incoming;
  t.rim.resize(static_cast<std::size_t>(end.rim));
  t.order.resize(static_cast<std::size_t>(4 * end.quad));
  t.length.resize(static_cast<std::size_t>(end.quad));
  t.neighbour.resize(static_cast<std::size_t>(end.slot));
  t.area_over_length.resize(static_cast<std::size_t>(end.slot));
  if (d.direct) t.direct_B.resize(static_cast<std::size_t>(end.slot));
  if (d.second_order) return;
  t.B.resize(static_cast<std::size_t>(end.slot));
  t.incoming_count.resize(static_cast<std::size_t>(end.node));
  t.incoming.resize(static_cast<std::size_t>(end.incoming));
}

class TileFiller {
 public:
  TileFiller(Tiles& t, const Discretization& d, const Tile& tile, const TilePlan& plan)
      : t_(t), d_(d), tile_(tile), rim_(plan.rim), order_(plan.order) {}

  void fill() {
    std::copy(rim_.begin(), rim_.end(), t_.rim.begin() + tile_.rim);
    for (std::size_t k = 0; k < order_.size(); ++k) {
      t_.order[static_cast<std::size_t>(4 * tile_.quad) + k] = local(order_[k]);
      if (k % 4 == 3)
        t_.length[static_cast<std::size_t>(tile_.quad) + k / 4] = static_cast<std::uint16_t>(bonds_of(d_, order_[k]));
    }
    for_each([&](std::size_t slot, Index a, Index i) { i >= 0 ? put_bond(slot, a, i) : put_padding(slot, a); });
    if (!d_.second_order) turn_round();
  }

 private:
  template <class Body>
  void for_each(Body&& body) const {
    for_each_slot(
        t_, tile_, [&](Index a) { return bonds_of(d_, a); },
        [&](Offset slot, Index a, Index i) { body(static_cast<std::size_t>(slot), a, i); });
  }

  void put_bond(std::size_t slot, Index a, Index i) {
    const auto k = static_cast<std::size_t>(d_.bonds.begin(a) + i);
    t_.neighbour[slot] = local(d_.bonds.neighbour[k]);
    t_.area_over_length[slot] = d_.bonds.area_over_length[k];
    if (!t_.B.empty()) t_.B[slot] = d_.bonds.B_ab[k];
    if (d_.direct)
      t_.direct_B[slot] = d_.direct->B_ba[static_cast<std::size_t>(d_.bonds.find(d_.bonds.neighbour[k], a))];
  }

  /// Leads to the first neighbour; the branch must not vanish.
  void put_padding(std::size_t slot, Index a) {
    const bool alone = bonds_of(d_, a) == 0;
    t_.neighbour[slot] = local(alone ? other_than(a) : d_.bonds.neighbour[static_cast<std::size_t>(d_.bonds.begin(a))]);
    t_.area_over_length[slot] = 0.0;
    if (!t_.B.empty()) t_.B[slot] = {};
    if (d_.direct) t_.direct_B[slot] = {};
  }

  /// A particle without bonds has padding only in a quad with one that has some.
  Index other_than(Index a) const { return a == tile_.begin ? a + 1 : a - 1; }

  std::uint16_t local(Index b) const {
    if (b >= tile_.begin && b < tile_.end) return static_cast<std::uint16_t>(b - tile_.begin);
    return static_cast<std::uint16_t>(tile_.size() + (std::lower_bound(rim_.begin(), rim_.end(), b) - rim_.begin()));
  }

  /// Sorts the tile's bonds by where they lead.
  void turn_round() {
    std::uint16_t* count = t_.incoming_count.data() + tile_.node;
    const std::size_t nodes = static_cast<std::size_t>(tile_.size()) + rim_.size();
    std::vector<Offset> next(nodes + 1, 0);
    for_each([&](std::size_t slot, Index, Index i) {
      if (i >= 0) ++next[t_.neighbour[slot] + std::size_t{1}];
    });
    for (std::size_t k = 0; k < nodes; ++k) {
      count[k] = static_cast<std::uint16_t>(next[k + 1]);
      next[k + 1] += next[k];
    }
    Tiles::Incoming* incoming = t_.incoming.data() + tile_.incoming;
    for_each([&](std::size_t slot, Index a, Index i) {
      if (i >= 0)
        incoming[next[t_.neighbour[slot]]++] = {
            local(a), static_cast<std::uint16_t>(slot - static_cast<std::size_t>(tile_.slot))};
    });
  }

  Tiles& t_;
  const Discretization& d_;
  const Tile& tile_;
  const std::vector<Index>&rim_, &order_;
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
  std::vector<TilePlan> plans(t.tiles.size());
  const auto tiles = static_cast<std::int64_t>(t.tiles.size());
  parallel::for_tasks(tiles, [&](std::int64_t k) {
    plans[static_cast<std::size_t>(k)] = plan(d, t.tiles[static_cast<std::size_t>(k)]);
  });
  place(t, d, plans);
  parallel::for_tasks(tiles, [&](std::int64_t k) {
    TileFiller(t, d, t.tiles[static_cast<std::size_t>(k)], plans[static_cast<std::size_t>(k)]).fill();
  });
  find_rim_places(t, d.particles());
  return t;
}

}  // namespace tessera
