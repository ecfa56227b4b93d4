#pragma once

#include <array>

#include "tessera/base/field.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/tiles.hpp"

// Second derivatives from first ones, tile by tile (theory, section 12): G_a = sum_b (F'_b - F'_a) (x) C_ab, H_a = S_a
// : G_a, positions of faces by q_a H_a + q_b H_b, and the mean H of a cell and its neighbours; then the same backwards.

namespace tessera {

struct System;

/// Six vectors, xx, xy, xz, yy, yz, zz: the second derivatives of the motion at a particle [1/m], or the derivatives of
/// an energy with respect to them [J m], mixed ones taken as one variable.
struct Hessian {
  double h[18];
};

/// What does not change, in the order of the tiles' slots and quads.
struct CurvatureRows {
  /// Of four particles.
  struct Constants {
    Double4 weight;       // q_a
    Double4 inverse_sum;  // 1 / (q_a + sum_b q_b) over the neighbours with a common face; zero where not resolved
    Double4 repeated;     // 1 less the slots that lead to the particle itself
    Double4 offset[3];    // sum_b C_ab [m]
  };
  RawField<std::uint16_t> near;  // as Tiles::neighbour, but the particle itself where there is no common face
  RawField<Double4> M;           // six for each four slots: (A/L) M_f / (q_a + q_b), mixed components twice [m3]
  RawField<Double4> map;         // the 54 numbers of S_a of the particles of each quad [1/m2]
  RawField<Constants> constants;
  std::vector<double> inverse_sum;  // the same by particles
  std::vector<CurvedSurface> surfaces;
};

/// Needs the bonds.
CurvatureRows curvature_rows(const Discretization& d, const Tiles& tiles);

/// Memory for one tile at a time, by local numbers.
struct CurvatureScratch {
  explicit CurvatureScratch(const Tiles& tiles);

  Field<double> nodes;          // what is known of the tile and its rim, at most 30 numbers each
  Field<Double4> centroid;      // [m]
  Field<ThreeTensors> moments;  // derivatives of the energies with respect to G_a, one tensor for each component of C
  Field<Columns> T;             // stress of the tile's own particles by way of F' [Pa]
};

/// q_a H_a of the tile's own particles from F'.
void hessian_sweep(const System& s, Index tile, const Tensor* F, CurvatureScratch& scratch, Hessian* weighted);

/// Adds to F of the tile's own particles what second derivatives do by the positions of faces, and sets their mean H.
void curvature_strain_sweep(const System& s, Index tile, const Hessian* weighted, CurvatureScratch& scratch, Tensor* F,
                            Hessian* mean);

/// The way back. `T` are complete stresses, `moment` the derivatives G of the energy with respect to the mean H. Sets
/// `T_first`, the stresses that the tile's own particles have by way of F', but for what `rim` is set to: what the tile
/// adds to V_b T_b of its rim [J].
void curvature_moment_sweep(const System& s, Index tile, const Tensor* T, const Hessian* moment,
                            CurvatureScratch& scratch, Tensor* T_first, Tensor* rim);

/// E_q = H_a p_q for q = 1 to 3, the columns of `points` being the p_q, for a in [begin, end).
void point_strain_sweep(const Mat3* points, Index begin, Index end, const Hessian* H, ThreeTensors* E);

/// The way back: sets G_a to the derivative of the energy with respect to the mean H_a that `Z`, those with respect to
/// the E_q, make.
void point_moment_sweep(const Mat3* points, Index begin, Index end, const ThreeTensors* Z, Hessian* G);

}  // namespace tessera
