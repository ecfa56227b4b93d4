#pragma once

#include <vector>

#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/surface_cutter.hpp"

namespace tessera {

/// The parts of the cell that was cut last as polyhedra, in their order; `X` is the cell's particle. Faces that are no
/// convex polygons, also those with holes, are divided into triangles.
std::vector<Polyhedron> outlines_of(const SurfaceCutter& cutter, Index particle, const Vec3& X);

/// Divides what closed lines in a plane with unit normal `normal` go around, counter-clockwise around the outside,
/// clockwise around holes, into polygons; one that is convex stays as it is.
std::vector<std::vector<Index>> polygons_within(std::vector<std::vector<Index>> loops, std::span<const Vec3> places,
                                                const Vec3& normal);

}  // namespace tessera
