#pragma once

#include "tessera/base/field.hpp"
#include "tessera/mechanics/curvature_rows.hpp"
#include "tessera/mechanics/kernel_types.hpp"

// Second derivatives from first ones, tile by tile (theory, section 12): G_a = sum_b (F'_b - F'_a) (x) C_ab, H_a = S_a
// : G_a, positions of faces by q_a H_a + q_b H_b, and the mean H of a cell and its neighbours; then the same backwards.
// Particles are taken one by one, their vectors in the lanes of a register; the fourth lane has a component of a
// position where there is one to have.

namespace tessera {

struct System;

/// Six vectors, xx, xy, xz, yy, yz, zz: the second derivatives of the motion at a particle [1/m], or the derivatives of
/// an energy with respect to them [J m], mixed ones taken as one variable.
struct Hessian {
  double h[18];
};

/// Derivatives of the energy of a cell with respect to G_a, for each component l of C the columns of a tensor Z_l; and
/// sum_l Z_l C_l, component l of whose columns is the fourth of those of Z_l [J/m], [J].
struct SentMoments {
  Double4 v[9];
};

/// Memory for one tile at a time, by local numbers.
struct CurvatureScratch {
  explicit CurvatureScratch(const Tiles& tiles);

  Field<Double4> nodes;        // what is known of the tile and its rim, at most nine vectors each
  Field<Double4> centroid;     // from the tile's first one [m]
  Field<SentMoments> moments;  // of the tile's own particles
  Field<Columns> T;            // stress of the tile's own particles by way of F' [Pa]
};

/// q_a H_a of the tile's own particles from F'.
void hessian_sweep(const System& s, Index tile, const Tensor* F, CurvatureScratch& scratch, Hessian* weighted);

/// Adds to F of the tile's own particles what second derivatives do by the positions of faces, and sets their mean H.
void curvature_strain_sweep(const System& s, Index tile, const Hessian* weighted, CurvatureScratch& scratch, Tensor* F,
                            Hessian* mean);

/// The way back. `T` are complete stresses, `moment` the derivatives of the energy with respect to sum_b q_b H_b over a
/// cell and its neighbours, G / sum q. Sets `T_first`, the stresses that the tile's own particles have by way of F',
/// but for what `rim` is set to: what the tile adds to V_b T_b of its rim [J].
void curvature_moment_sweep(const System& s, Index tile, const Tensor* T, const Hessian* moment,
                            CurvatureScratch& scratch, Tensor* T_first, Tensor* rim);

/// E_q = H_a p_q for q = 1 to 3, the columns of `points` being the p_q, for a in [begin, end).
void point_strain_sweep(const Symmetric3* points, Index begin, Index end, const Hessian* H, ThreeTensors* E);

/// The way back: sets G_a / sum q to what `Z`, the derivatives of the energy with respect to the E_q, make, with the
/// `inverse_sum` of each cell: nothing where it is not resolved.
void point_moment_sweep(const Symmetric3* points, const double* inverse_sum, Index begin, Index end,
                        const ThreeTensors* Z, Hessian* G);

}  // namespace tessera
