#pragma once

#include <array>
#include <vector>

#include "tessera/base/field.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/mechanics/tiles.hpp"

namespace tessera {

/// What the sweeps of second order read of the body. A tile's own particles have one row each, in their order, so that
/// neighbours stay near: neighbours with a common face, then other bonds, then what the fit takes beyond the former.
/// Each face of a tile has one number, and those that a row is the first to name follow each other.
struct CurvatureRows {
  /// Where a tile's data begin.
  struct Start {
    Offset neighbour = 0;  // in neighbours
    Offset other = 0;      // in others; both together in B
    Offset far = 0;        // in far
    Offset mean = 0;       // in means
    Offset face = 0;       // in M
    Offset averaged = 0;   // cells that use means, before the tile's
  };
  struct Row {
    std::uint16_t neighbours = 0;
    std::uint16_t others = 0;
    std::uint16_t far = 0;
    std::uint16_t means = 0;
    std::uint16_t first_named = 0;  // faces that no row before has named
    std::uint16_t averaged = 0;     // 1 where the cell uses the mean of second derivatives
  };
  struct Neighbour {
    std::uint16_t cell;  // local number
    std::uint16_t face;  // number within the tile
  };
  using FaceFactors = std::array<double, 6>;  // xx, xy, xz, yy, yz, zz

  static constexpr Index padding = 8;  // what is read ahead of means

  std::vector<Start> start;  // of each tile, and an end mark
  RawField<Row> rows;        // one a particle
  RawField<Neighbour> neighbours;
  RawField<std::uint16_t> others, far;  // local numbers
  RawField<Index> means;                // neighbours that use means, to which the particle's H_a belongs; then padding
  RawField<Vec3> B;                     // B_ab of neighbours and others [m2]
  RawField<FaceFactors> M;              // (A/L) M_f / (q_a + q_b), mixed components twice [m3]
  RawField<QuadraticFit> fit;           // q_a S_a and A_a
  std::vector<double> inverse_sum;      // 1 / q_a, or that of the mean's sum; by particles; zero where not resolved
};

/// Needs the bonds.
CurvatureRows curvature_rows(const Discretization& d, const Tiles& tiles);

}  // namespace tessera
