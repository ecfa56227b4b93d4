#pragma once

#include "tessera/geometry/triangle_surface.hpp"

namespace tessera {

/// Solids with curved sides, faceted: all vertices lie on the true surface, and no point of a facet is farther from it
/// than `tolerance` [m]. They are centred at the origin or stand on the plane z = 0 with their axis along z. All
/// throw GeometryError for lengths that are not positive, and for tolerances that would take more than ten million
/// triangles.

/// Sides "bottom" (z = 0), "top" (z = height), "mantle".
TriangleSurface cylinder_surface(double radius, double height, double tolerance);

/// A cone, truncated unless one of the radii is zero. Sides "bottom" (z = 0), "top" (z = height), as far as there are
/// any, and "mantle".
TriangleSurface cone_surface(double bottom_radius, double top_radius, double height, double tolerance);

/// Side "mantle".
TriangleSurface sphere_surface(double radius, double tolerance);

/// The same between the discs around `from` ("bottom") and `to` ("top"), which must differ; a disc across a coordinate
/// axis is exactly flat.
TriangleSurface cone_surface(const Vec3& from, const Vec3& to, double bottom_radius, double top_radius,
                             double tolerance);

/// Semi-axes along x, y, z. Side "mantle".
TriangleSurface ellipsoid_surface(const Vec3& semi_axes, double tolerance);

/// The circle of `radius` around z in the plane z = 0, thickened to `tube_radius` < radius. Side "mantle".
TriangleSurface torus_surface(double radius, double tube_radius, double tolerance);

}  // namespace tessera
