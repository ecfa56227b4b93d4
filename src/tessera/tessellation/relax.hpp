#pragma once

#include <vector>

#include "tessera/geometry/particles.hpp"

namespace tessera {

/// Relaxed particles and how near they have come to the centroids of their cells.
struct Relaxed {
  std::vector<Vec3> points;  // [m]
  int iterations = 0;
  double distance = 0.0;  // root mean square, in local spacings, after the last iteration
};

/// Moves points towards a centroidal Voronoi tessellation of the solid: each goes to the centroid of its cell, as the
/// solid cuts it (S. Lloyd, Least squares quantization in PCM, IEEE Trans. Inf. Theory 28, 1982), carried on by part of
/// its last move (Y. Nesterov, 1983; restarts as B. O'Donoghue, E. Candes, Found. Comput. Math. 15, 2015), which takes
/// far fewer iterations. Centroids are those of a density size^-5 (size^-4 in two dimensions), which makes cells as
/// large as the size wants them (A. Gersho, Asymptotically optimal block quantization, IEEE Trans. Inf. Theory 25,
/// 1979), to first order in the change of the size over a cell.
///
/// Points stay in the solid. The result has the same bits for any number of threads.
Relaxed relax(std::vector<Vec3> points, const Solid& solid, const RelaxedSpec& spec, int dimension);
/// The same in what a surface encloses. Only cells near the surface are cut by it.
Relaxed relax(std::vector<Vec3> points, const SurfaceIndex& index, const RelaxedSpec& spec);

}  // namespace tessera
