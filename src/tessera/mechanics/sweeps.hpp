#pragma once

#include <array>
#include <limits>

#include "tessera/laws/lanes_response.hpp"
#include "tessera/mechanics/kernel_types.hpp"
#include "tessera/mechanics/system.hpp"
#include "tessera/mechanics/tensor_rows.hpp"

namespace tessera {

/// What a stress sweep adds up on the way.
struct StressSums {
  double internal = 0.0;    // sum V_a U(F_a) [J]
  double contact = 0.0;     // sum of the bonds' energies [J]
  double dissipated = 0.0;  // viscous work since the last evaluation, and by plastic flow since the history [J]
  double smallest_J = std::numeric_limits<double>::infinity();
  bool finite = true;  // no J was NaN

  StressSums& operator+=(const StressSums& o);
};

/// Data of the viscous stress; only allocated when a material is viscous.
struct ViscousMemory {
  Field<Tensor> F_previous;  // F_a one step ago
  Field<Tensor> P_previous;  // viscous stress one step ago [Pa]
};

/// May the solid flow, or does it answer elastically about what has flowed before?
enum class Flow { allowed, held };

/// The histories of all stress points, before and after the present deformation: null where no material has any.
/// `after` is also null where nothing is to be kept.
struct HistorySpan {
  const PlasticState* before = nullptr;
  PlasticState* after = nullptr;
  Flow flow = Flow::allowed;

  /// Those of four stress points.
  LanesHistory lanes(std::array<Offset, 4> points) const {
    LanesHistory four;
    for (std::size_t k = 0; k < 4; ++k) {
      if (before != nullptr) four.before[k] = before + points[k];
      if (after != nullptr) four.after[k] = after + points[k];
    }
    return four;
  }
};

/// What is known of one particle while a tile is worked on: two cache lines that are read in pairs of numbers.
struct alignas(64) TileNode {
  double value[16];  // F/2 column by column, position and reference position [m], and one number that means nothing
};

/// Memory for one tile at a time, by local numbers.
struct TileScratch {
  explicit TileScratch(const System& s);

  Field<Double4> x;  // positions for the strain sweep [m]
  Field<TileNode> nodes;
  Field<Columns> T;  // stress of the tile's own particles that the bonds hand on [Pa]
  Field<Columns> P;  // elastic and viscous part of it where it goes another way, else empty

  // Of cell integration, else empty.
  Field<Double4> centroid;
  Field<TensorRows> moments;        // derivatives of the energies of the tile's own cells with respect to G_a [J m]
  Field<Double4> gradient_weights;  // C_ab / r^2 of each slot [1/m]
};

/// Sweep 1: F_a = (1/V_a) sum_b x_ab (x) B_ab, [D 32], [V 6], boundary nodes left out.
void strain_sweep(const System& s, Index tile, const Double4* x, Tensor* F, TileScratch& scratch);

/// Sweep 2, first half. Copies the values of the tile and its rim; f_a = sum_b dU_ab/dx_ab, [D 57], and the contact
/// stress T_a = Q_a = (1/2V_a) sum_b dU_ab/dy_ab (x) X_ab, [D 58], of the tile's own particles.
double contact_sweep(const System& s, Index tile, const Double4* x, const Tensor* F, Double4* f, TileScratch& scratch);

/// The same on one bond of each of four particles at once, whatever the processor. Its forces and stresses have the
/// same bits; the energy is added up in another order.
double contact_sweep_of_four(const System& s, Index tile, const Double4* x, const Tensor* F, Double4* f,
                             TileScratch& scratch);

/// Sweep 2, second half: the elastic and viscous stress P(F_a) of the tile's own particles, added to T or, where the
/// scratch has room for P, put there. `dt` is the time since the last evaluation (viscosity), zero at the first one;
/// `viscous` is null without viscosity.
StressSums stress_sweep(const System& s, Index tile, const Tensor* F, const HistorySpan& history,
                        ViscousMemory* viscous, double dt, TileScratch& scratch);

/// The same where the elastic stresses of all particles are known already: hands `P` of the tile's own particles on.
StressSums known_stress_sweep(const System& s, Index tile, const Tensor* F, const Tensor* P, ViscousMemory* viscous,
                              double dt, TileScratch& scratch);

/// Sweep 3: what the tile's own particles do by their stress T, f_b -= T_a B_ab and f_a -= T_a B_aa, [D 45], [V 41]:
/// to each other in `f`, to the rim in `rim_f`, which is set.
void force_sweep(const System& s, Index tile, const Columns* T, const Vec3* B, const Vec3* B_aa, Double4* f,
                 Double4* rim_f);

/// f_a and what other tiles have put into their rims, a in [begin, end); `f` and `total` begin there and may be the
/// same.
void collect_rims(const Tiles& tiles, const Double4* rim_f, const Double4* f, Double4* total, Index begin, Index end);

}  // namespace tessera
