#pragma once

#include "tessera/base/mat3.hpp"
#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// The surface with every vertex X moved to A X + shift. A mirroring A turns the triangles round, so that they keep
/// looking outwards. A must be invertible.
TriangleSurface transformed(TriangleSurface surface, const Mat3& A, const Vec3& shift);

/// The rotation by `angle` [degrees] around `axis`, counter-clockwise seen from its tip; exact for quarter turns around
/// the coordinate axes. The axis has a length that is not zero.
Mat3 rotation(const Vec3& axis, double angle);

/// A rotation that takes the z axis to the direction of `axis`, whose length is not zero; exact for coordinate axes.
Mat3 frame_along(const Vec3& axis);

}  // namespace tessera
