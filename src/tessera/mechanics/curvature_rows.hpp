#pragma once

#include <array>
#include <vector>

#include "tessera/base/field.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/mechanics/tiles.hpp"

namespace tessera {

/// What the sweeps of second derivatives read of the body. A tile's own particles have one row each, in their order, so
/// that neighbours stay near: the neighbours with a common face. Each face of a tile has one number, and those that a
/// row is the first to name follow each other.
struct CurvatureRows {
  /// Where a tile's data begin.
  struct Start {
    Offset neighbour = 0;  // in neighbours and senders
    Offset face = 0;       // in M
  };
  struct Row {
    std::uint16_t neighbours = 0;
    std::uint16_t first_named = 0;  // faces that no row before has named
  };
  struct Neighbour {
    std::uint16_t cell;  // local number
    std::uint16_t face;  // number within the tile
  };
  using FaceFactors = std::array<double, 6>;  // xx, xy, xz, yy, yz, zz

  std::vector<Start> start;  // of each tile, and an end mark
  RawField<Row> rows;        // one a particle
  RawField<Neighbour> neighbours;
  RawField<FaceFactors> M;               // (A/L) M_f / (q_a + q_b), mixed components twice [m3]
  RawField<SecondDerivatives::Map> map;  // q_a S_a [1/m2]
  RawField<Vec3> offset;                 // sum_b C_ab over the neighbours [m]

  // The same neighbours by who receives: of each local number the own particles that have it in their rows.
  RawField<std::uint16_t> sender_count;  // from Tile::node on
  RawField<std::uint16_t> senders;       // local numbers

  std::vector<double> inverse_sum;  // 1 / (q_a + sum_b q_b), by particles; zero where not resolved
};

/// Needs the bonds.
CurvatureRows curvature_rows(const Discretization& d, const Tiles& tiles);

}  // namespace tessera
