#pragma once

#include "tessera/base/field.hpp"
#include "tessera/mechanics/curvature_rows.hpp"
#include "tessera/mechanics/kernel_types.hpp"

// The sweeps of second order, tile by tile (theory, section 12): first and second derivatives of the motion, then the
// positions of faces by q_a H_a + q_b H_b; then the same backwards. Particles are taken one by one, their vectors in
// the lanes of a register; the fourth lane has a component of a position where there is one to have.

namespace tessera {

struct System;

/// Six vectors, xx, xy, xz, yy, yz, zz: the second derivatives of the motion at a particle [1/m], or the derivatives of
/// an energy with respect to them [J m], mixed ones taken as one variable.
struct Hessian {
  double h[18];
};

/// Memory for one tile at a time, by local numbers.
struct CurvatureScratch {
  explicit CurvatureScratch(const Tiles& tiles);

  Field<Double4> nodes;  // what is known of the tile and its rim, at most nine vectors each
  Field<Double4> force;  // on each of them [N]
};

/// Sets F of the tile's own particles to what bonds between particles do, and q_a H_a.
void derivative_sweep(const System& s, Index tile, const Double4* x, CurvatureScratch& scratch, Tensor* F,
                      Hessian* weighted);

/// Adds to F of the tile's own particles what second derivatives do by the positions of faces. Of the cells that use
/// means it sets the `sums` of q_b H_b, one for each such cell of the body.
void face_sweep(const System& s, Index tile, const Hessian* weighted, CurvatureScratch& scratch, Tensor* F,
                Hessian* sums);

/// The way back. `T` are complete stresses, `moment` the derivatives of the energy with respect to q_a H_a, or to the
/// sum of those where the cell uses the mean, by its points and surface. Adds the forces of the tile's own particles,
/// by first and second derivatives, to `f` and sets those on its rim, `rim_f`.
void derivative_force_sweep(const System& s, Index tile, const Tensor* T, const Hessian* moment,
                            CurvatureScratch& scratch, Double4* f, Double4* rim_f);

/// E_q = H_a p_q for q = 1 to 3, the columns of `points` being the p_q, for a in [begin, end); H is `inverse_sum` times
/// `weighted`.
void point_strain_sweep(const Symmetric3* points, const double* inverse_sum, Index begin, Index end,
                        const Hessian* weighted, ThreeTensors* E);

/// The way back: sets G_a / sum q to what `Z`, the derivatives of the energy with respect to the E_q, make, with the
/// `inverse_sum` of each cell: nothing where it is not resolved.
void point_moment_sweep(const Symmetric3* points, const double* inverse_sum, Index begin, Index end,
                        const ThreeTensors* Z, Hessian* G);

}  // namespace tessera
