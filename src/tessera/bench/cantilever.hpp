#pragma once

#include <cstdint>
#include <vector>

#include "tessera/simulation/case.hpp"

namespace tessera {

/// The swinging cantilever of [D 8.4], as examples/cantilever has it: a rubber beam of 6 m x 1 m x 1 m, clamped at
/// X = 0, that starts with 10 m/s X / 6 m upwards. Particles on a lattice with a jitter of 0.2; voronoi is the
/// consistent formulation. The step is the default of a case file, spectral. The run ends at 1 s.
Case cantilever_case(Formulation formulation, int per_metre, Integration integration = Integration::nodal);

/// Where the upper corner of the free end is at the times of the reference, as (x1, x3) [m]; for voronoi the centre of
/// the lattice cell at that corner, where there is a reference for it (4, 8 and 16 per metre).
struct CantileverPath {
  std::int64_t particles = 0;
  std::int64_t steps = 0;
  double seconds = 0.0;  // wall-clock time of choosing and taking all steps, without set-up and looking at the path
  std::vector<Vec3> x;   // of the followed point, x2 as well [m]
};

/// Runs the case with the present number of threads. Throws RunError as any run, and UsageError for a number per metre
/// of voronoi cells that the reference knows no point for.
CantileverPath run_cantilever(Formulation formulation, int per_metre, Integration integration = Integration::nodal);

/// The relative L2 norm over 0 .. 1 s of the path's distance from the reference in the plane of motion,
/// sqrt(sum |x - x_ref|^2 / sum |x_ref - X|^2).
double path_error(const CantileverPath& path, Formulation formulation, int per_metre);

}  // namespace tessera
