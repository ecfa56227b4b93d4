#include "tessera/discretization/voronoi_common.hpp"

#include <algorithm>

namespace tessera {

namespace {

struct OwnedFace {
  Index owner;
  FaceOfCell face;
};

}  // namespace

Csr<FaceOfCell> faces_of_cells(const Cells& cells) {
  std::vector<OwnedFace> owned;
  owned.reserve(2 * cells.interior.size() + cells.boundary.size());
  for (std::size_t i = 0; i < cells.interior.size(); ++i) {
    const InteriorFace& f = cells.interior[i];
    owned.push_back({f.a, {f.b, static_cast<Index>(i)}});
    owned.push_back({f.b, {f.a, static_cast<Index>(i)}});
  }
  const auto first_boundary = owned.size();
  std::sort(owned.begin(), owned.end(), [](const OwnedFace& l, const OwnedFace& r) {
    return l.owner != r.owner ? l.owner < r.owner : l.face.neighbour < r.face.neighbour;
  });
  for (std::size_t i = 0; i < cells.boundary.size(); ++i)
    owned.push_back({cells.boundary[i].owner, {-1, static_cast<Index>(i)}});
  std::inplace_merge(owned.begin(), owned.begin() + static_cast<std::ptrdiff_t>(first_boundary), owned.end(),
                     [](const OwnedFace& l, const OwnedFace& r) { return l.owner < r.owner; });

  const Csr<OwnedFace> rows = group_by_row<OwnedFace>(static_cast<Index>(cells.volume.size()), owned,
                                                      [](const OwnedFace& f) { return f.owner; });
  Csr<FaceOfCell> faces;
  faces.offset = rows.offset;
  faces.value.reserve(rows.value.size());
  for (const OwnedFace& f : rows.value) faces.value.push_back(f.face);
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
