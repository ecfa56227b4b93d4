#pragma once

#include "tessera/geometry/file_surface.hpp"
#include "tessera/geometry/surface_mend.hpp"

namespace tessera {

/// A surface that bounds a solid, and what had to be mended for it.
struct CheckedSurface {
  TriangleSurface surface;  // lengths as they came
  SurfaceRepairs repairs;
  Index shells = 0;    // closed surfaces that bound parts of the solid from outside
  Index cavities = 0;  // closed surfaces that bound holes within
};

/// Welds, mends what can only be meant one way, and checks that a surface bounds a solid: it is closed, nowhere meets
/// itself but at common edges and vertices, and is seen counter-clockwise from outside, also where it bounds a cavity.
/// Throws GeometryError that says what is wrong, how often and where, and what helps.
CheckedSurface check_surface(FileSurface file);
/// The same with a tolerance for welding and mending of one's own [the file's unit].
CheckedSurface check_surface(FileSurface file, double tolerance);

/// The parts of check_surface, each of which throws GeometryError.
void refuse_bad_vertices(const FileSurface& file);
void refuse_holes(const FileSurface& file);
void refuse_contrary_edges(const FileSurface& file);
void refuse_wrong_meetings(const FileSurface& file);

/// The closed surfaces that make up a surface whose triangles meet rightly.
struct Shells {
  std::vector<Index> of;       // per triangle: number of its shell, counted by first triangles
  std::vector<double> volume;  // per shell, negative for cavities [m3]
};
Shells find_shells(const TriangleSurface& surface);

/// Refuses shells that are inside out and shells within others that bound no cavity.
void refuse_wrong_nesting(const FileSurface& file, const Shells& shells);

}  // namespace tessera
