#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tessera/base/field.hpp"
#include "tessera/base/index.hpp"
#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// Consecutive particles of one material that are worked on together, and where their data begin in the arrays of
/// Tiles. Particles of other tiles to which bonds lead are the tile's rim. Within a tile particles have local numbers:
/// its own in order, then the rim.
struct Tile {
  Index begin = 0;
  Index end = 0;
  Index material = 0;
  Index first_owner = 0;  // of boundary nodes, in System::owners
  Offset rim = 0;
  Offset bond = 0;  // in B
  Offset lane = 0;  // in neighbour and area_over_length
  Offset node = 0;  // in incoming_count
  Offset incoming = 0;

  Index size() const { return end - begin; }
};

/// The bonds as the sweeps read them: every array is streamed once a sweep, and what neighbours hold is found in a copy
/// of the tile's values that stays in the cache.
struct Tiles {
  std::vector<Tile> tiles;  // and an end mark
  RawField<Index> rim;      // particles, ascending within a tile

  // One row a particle, padded to a multiple of four entries (of no stiffness) that one register takes at once.
  RawField<std::uint16_t> count;      // bonds of each particle
  RawField<std::uint16_t> neighbour;  // local number
  RawField<double> area_over_length;  // [m]
  // One row a particle, not padded.
  RawField<Vec3> B;         // B_ab, [m2]
  RawField<Vec3> direct_B;  // of [V 42]: what P_a does to b by the bond a -> b; empty if that is B_ab

  /// The bonds of a tile that lead to a local particle: one row each.
  struct Incoming {
    std::uint16_t from;  // local number of a
    std::uint16_t bond;  // position of a -> b, counted from the tile's first
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

struct MaterialRange;

/// A size of tiles that keeps a tile's values in the cache and many threads busy.
Index tile_size(Index particles);

/// Cuts the particles into tiles of at most `size`; forces do not depend on it but for round-off. Throws GeometryError
/// that names a particle with more bonds than a tile can number.
Tiles make_tiles(const Discretization& d, const std::vector<MaterialRange>& ranges, Index size);

}  // namespace tessera
