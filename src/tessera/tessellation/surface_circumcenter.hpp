#pragma once

#include <array>
#include <span>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/tessellation/generators.hpp"

namespace tessera {

struct Circumcenter {
  Vec3 X;                  // [m]
  double condition = 1.0;  // how much larger than round-off the error may be; infinite when X is arbitrary on a line
};

/// The point equally far from four generators, given in ascending order: a corner of their Voronoi cells. With weights
/// it is the corner of their power cells, "equally far" meaning the least |x - X_g|^2 - w_g. It lies on
/// all bisectors to round-off, also where the generators are nearly in one plane; when they are in one plane and on
/// one circle to within round-off, so that a whole line is equally far from them, it is the center of that circle.
Circumcenter circumcenter(const Generators& points, const std::array<Index, 4>& generators);

}  // namespace tessera
