#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tessera/base/field.hpp"
#include "tessera/base/index.hpp"
#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// Consecutive particles of one material that are worked on together, and where their data begin in the arrays of
/// Tiles. Particles of other tiles to which bonds lead, or which second derivatives
/// follow, are the tile's rim. Within a tile particles have local numbers:
/// its own in order, then the rim.
struct Tile {
  Index begin = 0;
  Index end = 0;
  Index material = 0;
  Index first_owner = 0;  // of boundary nodes, in System::owners
  Offset rim = 0;
  Offset quad = 0;  // in length, and a quarter of that in order
  Offset slot = 0;  // in neighbour, area_over_length and B
  Offset node = 0;  // in incoming_count
  Offset incoming = 0;

  Index size() const { return end - begin; }
  Index quads() const { return (size() + 3) / 4; }
};

/// The bonds as the sweeps read them: every array is streamed once a sweep, and what neighbours hold is found in a copy
/// of the tile's values that stays in the cache.
struct Tiles {
  std::vector<Tile> tiles;  // and an end mark
  RawField<Index> rim;      // particles, ascending within a tile

  // A tile's own particles are taken four at a time, quads of about as many bonds each, so that the lanes of a register
  // hold four particles. The i-th bonds of the four are next to each other: slot 4 i + lane of the quad. Rows end in
  // padding that leads to a neighbour and does nothing (B and A/L are zero).
  RawField<std::uint16_t> order;      // local numbers; the last quad is filled up with its last particle
  RawField<std::uint16_t> length;     // of the longest row of each quad
  RawField<std::uint16_t> neighbour;  // local number
  RawField<double> area_over_length;  // [m]
  RawField<Vec3> B;                   // B_ab [m2]; empty in second order, where CurvatureRows have it
  RawField<Vec3> direct_B;            // of [V 42]: what P_a does to b by the bond a -> b; empty if that is B_ab

  /// The bonds of a tile that lead to a local particle: one row each. Empty in second order.
  struct Incoming {
    std::uint16_t from;  // local number of a
    std::uint16_t slot;  // of a -> b, counted from the tile's first
  };
  RawField<std::uint16_t> incoming_count;
  RawField<Incoming> incoming;

  // Where a particle is in the rims of other tiles: positions in `rim`, ascending. One row a particle.
  std::vector<Offset> rim_offset{0};
  std::vector<Index> rim_place;

  Index most_particles = 0;  // of a tile
  Index most_nodes = 0;      // the rim included
  Offset bonds = 0;

  Index size() const { return static_cast<Index>(tiles.size()) - 1; }
  Index rim_size(Index tile) const {
    return static_cast<Index>(end_of(tile).rim - tiles[static_cast<std::size_t>(tile)].rim);
  }
  const Tile& end_of(Index tile) const { return tiles[static_cast<std::size_t>(tile) + 1]; }
};

/// Calls body(slot, a, i) for every slot of a tile in the order of memory: the slot's place in the arrays, the particle
/// whose row it is in, and the number of the bond in that row, or -1 in padding. `bonds_of` gives the bonds of a
/// particle.
template <class BondsOf, class Body>
void for_each_slot(const Tiles& t, const Tile& tile, const BondsOf& bonds_of, Body&& body) {
  Offset slot = tile.slot;
  const std::uint16_t* order = t.order.data() + 4 * tile.quad;
  const std::uint16_t* length = t.length.data() + tile.quad;
  for (Index q = 0; q < tile.quads(); ++q)
    for (Index i = 0; i < length[q]; ++i)
      for (Index lane = 0; lane < 4; ++lane, ++slot) {
        const Index a = tile.begin + order[4 * q + lane];
        const bool bond = 4 * q + lane < tile.size() && i < bonds_of(a);
        body(slot, a, bond ? i : -1);
      }
}

struct MaterialRange;

/// A size of tiles that keeps a tile's values in the cache and many threads busy.
Index tile_size(Index particles);

/// Cuts the particles into tiles of at most `size`; forces do not depend on it but for round-off. Throws GeometryError
/// that names a particle with more bonds than a tile can number.
Tiles make_tiles(const Discretization& d, const std::vector<MaterialRange>& ranges, Index size);

}  // namespace tessera
