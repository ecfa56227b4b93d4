#pragma once

#include <array>
#include <span>

#include "tessera/base/csr.hpp"
#include "tessera/base/field.hpp"
#include "tessera/discretization/discretization.hpp"
#include "tessera/mechanics/kernel_types.hpp"

namespace tessera {

/// The second derivatives of the motion at a particle (xx, xy, xz, yy, yz, zz), or the derivatives of an energy with
/// respect to them, mixed ones taken as one variable.
struct Hessian {
  std::array<Double4, 6> h{};
};

/// What the particles' second derivatives follow from and what they do, in the order in which it is read. Index rows
/// are read from begin to end of a range of particles.
struct HessianRows {
  /// A face as one of its cells sees it. `m` is M_f/2, mixed components twice, so that c_f gains sum m (h_a + h_b).
  struct Face {
    Index neighbour;
    std::array<double, 3> area;
    std::array<double, 6> m;
  };

  Field<Double4> X;         // reference positions [m]
  Csr<Index> stencil;       // of each fit
  Csr<Index> reached_from;  // the particles in whose fits this one is
  RawField<QuadraticFit> fit;
  RawField<std::array<double, 6>> own;  // - sum_b W_ab [1/m2]
  std::vector<Offset> first_face;
  RawField<Face> faces;
  std::vector<CurvedSurface> surfaces;  // sorted by particle
};

HessianRows hessian_rows(const Discretization& d);

/// H_a = sum_b W_ab (x_b - x_a) for a in [begin, end).
void hessian_sweep(const HessianRows& rows, Index begin, Index end, const Double4* x, Hessian* H);

/// Adds to F_a what second derivatives do: (1/V_a) sum_f (H_f : M_f) (x) A_f, for a in [begin, end).
void curvature_strain_sweep(const HessianRows& rows, const double* volume, Index begin, Index end, const Hessian* H,
                            Tensor* F);

/// E_q = H_a p_q for q = 1 to 3, the columns of `points` being the p_q, for a in [begin, end).
void point_strain_sweep(const Mat3* points, Index begin, Index end, const Hessian* H, ThreeTensors* E);

/// The way back: sets G_a to the derivative of the energy with respect to H_a that `Z`, those with respect to the E_q,
/// make.
void point_moment_sweep(const Mat3* points, Index begin, Index end, const ThreeTensors* Z, Hessian* G);

/// What a fit does by the derivative G_a of the energy with respect to H_a: g_a = S_a^T G_a.
struct FitMoment {
  std::array<Double4, 9> g;
};

/// Adds to G_a, a in [begin, end), what the stresses T do by the positions of faces, and sets g_a.
void curvature_moment_sweep(const HessianRows& rows, Index begin, Index end, const Tensor* T, Hessian* G, FitMoment* g);

/// f_a -= sum_b W_ba G_b, over all fits in which a is, its own included, for a in [begin, end).
void hessian_force_sweep(const HessianRows& rows, Index begin, Index end, const Hessian* G, const FitMoment* g,
                         Double4* f);

}  // namespace tessera
