#pragma once

#include <span>
#include <string>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// A flat piece of a body's boundary as conditions see it: a cell's face (voronoi) or a triangle (delaunay).
struct SurfacePiece {
  Vec3 centroid;  // [m]
  Vec3 N;         // outward unit normal
  Index side = -1;
  std::vector<Index> vertices;  // particles at its corners (delaunay only)
};

/// The boundary of one body, with what selections need to know of it.
struct Surface {
  std::string body;
  std::vector<SurfacePiece> pieces;
  std::vector<std::vector<std::string>> side_names;  // of each side
  std::vector<std::string> known_names;              // sorted
  Vec3 lower, upper;                                 // bounding box [m]

  std::span<const std::string> names_of(const SurfacePiece& piece) const;
};

}  // namespace tessera
