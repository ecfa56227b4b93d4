#include "tessera/discretization/voronoi_common.hpp"

namespace tessera {

Csr<FaceOfCell> faces_of_cells(const Cells& cells) {
  // Interior faces are sorted by (a, b): visiting them in order fills every row by ascending neighbour.
  Csr<FaceOfCell> faces;
  faces.offset.assign(cells.volume.size() + 1, 0);
  const auto count = [&](Index a) { ++faces.offset[static_cast<std::size_t>(a) + 1]; };
  for (const InteriorFace& f : cells.interior) count(f.a), count(f.b);
  for (const BoundaryFace& f : cells.boundary) count(f.owner);
  for (std::size_t a = 0; a < cells.volume.size(); ++a) faces.offset[a + 1] += faces.offset[a];
  faces.value.resize(static_cast<std::size_t>(faces.offset.back()));

  std::vector<Offset> next(faces.offset.begin(), faces.offset.end() - 1);
  const auto put = [&](Index a, Index neighbour, std::size_t face) {
    faces.value[static_cast<std::size_t>(next[static_cast<std::size_t>(a)]++)] = {neighbour, static_cast<Index>(face)};
  };
  for (std::size_t i = 0; i < cells.interior.size(); ++i) {
    put(cells.interior[i].a, cells.interior[i].b, i);
    put(cells.interior[i].b, cells.interior[i].a, i);
  }
  for (std::size_t i = 0; i < cells.boundary.size(); ++i) put(cells.boundary[i].owner, -1, i);
  return faces;
}

void describe_particles(Discretization& d, std::span<const Vec3> X, const Cells& cells) {
  d.X.assign(X.begin(), X.end());
  d.volume = cells.volume;
  for (double V : cells.volume) d.body_volume += V;
  d.sites.reserve(cells.boundary.size());
  for (const BoundaryFace& f : cells.boundary)
    d.sites.push_back({f.centroid, normalized(f.area), f.centroid, f.side, f.owner});
}

}  // namespace tessera
