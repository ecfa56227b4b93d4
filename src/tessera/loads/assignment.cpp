#include "tessera/loads/assignment.hpp"

#include "tessera/loads/condition_values.hpp"
#include "tessera/loads/selected.hpp"

namespace tessera {

namespace {

bool overlap(const Mat3& D, const Mat3& E) {
  const Mat3 product = D * E;
  return contract(product, product) > 1e-18;
}

}  // namespace

std::vector<PointConstraint> constrain_faces(const Surface& surface,
                                             std::span<const BoundaryCondition* const> conditions) {
  std::vector<PointConstraint> faces(surface.pieces.size());
  for (const BoundaryCondition* c : conditions) {
    if (is_load(*c)) continue;
    const Selection where = selection_of(*c, surface);
    bool taken = false;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const SurfacePiece& piece = surface.pieces[i];
      if (!where.takes({piece.centroid, surface.names_of(piece)})) continue;
      taken = true;
      const auto [D, M] = held_directions(*c, piece.N);
      for (const MotionPart& earlier : faces[i].parts)
        if (overlap(D, held_directions(*earlier.condition, piece.N).D))
          report_conflict(*c, *earlier.condition, "boundary face", piece.centroid);
      if (contract(D, D) == 0.0) continue;
      faces[i].D += D;
      faces[i].parts.push_back({c, M});
    }
    if (!taken) report_nothing(*c, surface, "boundary face");
  }
  return faces;
}

std::vector<LoadedPiece> load_pieces(const Surface& surface, std::span<const BoundaryCondition* const> conditions) {
  std::vector<LoadedPiece> loaded;
  for (const BoundaryCondition* c : conditions) {
    if (!is_load(*c)) continue;
    const Selection where = selection_of(*c, surface);
    const std::size_t before = loaded.size();
    for (std::size_t i = 0; i < surface.pieces.size(); ++i)
      if (where.takes({surface.pieces[i].centroid, surface.names_of(surface.pieces[i])}))
        loaded.push_back({static_cast<Index>(i), c});
    if (loaded.size() == before) report_nothing(*c, surface, "boundary face");
  }
  return loaded;
}

}  // namespace tessera
