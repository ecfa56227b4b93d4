#pragma once

#include <span>
#include <vector>

#include "tessera/loads/surface.hpp"

namespace tessera {

/// Triangles of one entry that meet at less than this angle count as one curved side [degrees].
inline constexpr double kSmoothAngle = 40.0;

/// What an entry takes of a surface whose corners are particles: per piece and per particle.
struct Taken {
  std::vector<char> piece, particle;
};

/// The normals that the pieces which an entry takes have at each particle. Pieces that meet at less than kSmoothAngle
/// are facets of one curved side and give one normal, the mean weighted with their angles at the particle; sharper
/// edges part sides, and each gives its own. A particle at the rim of a formula may have no whole piece; it takes the
/// normals that it shares with the rest of the entry. `X` are the particles' material positions.
std::vector<std::vector<Vec3>> side_normals(const Surface& surface, std::span<const Vec3> X, const Taken& taken);

}  // namespace tessera
