#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/symmetric.hpp"
#include "tessera/tessellation/cells.hpp"
#include "tessera/tessellation/generators.hpp"
#include "tessera/tessellation/surface_cutter.hpp"

namespace tessera {

/// A face where it is stored; `second` is null where second moments are not wanted.
struct StoredFace {
  Index neighbour, patch;
  const FlatArea* piece;
  const Symmetric3* second;
};

/// What a face needs to be more than round-off, in a cell of volume V whose particle is at X [m2].
double smallest_face(const Vec3& X, double V);

/// A second moment about a point at `shift` from the new one, turned to that: `size` and `moment` are those about the
/// old one.
Symmetric3 moved(const Symmetric3& second, const Vec3& moment, double size, const Vec3& shift);

/// Collects the faces of cells that a surface cuts, and puts the pieces of one face together.
class SurfaceFaceList {
 public:
  SurfaceFaceList(const Generators& points, const SurfacePlanes& planes) : points_(points), planes_(planes) {}

  /// A face of the cell that was cut around `cell`, between what belongs to a and b now; b is -1 on the boundary.
  void add(Index cell, const StoredFace& face, Index a, Index b, const std::vector<double>& volume);

  /// Gives `cells` all faces, in the order of their particles.
  void move_to(Cells& cells);

 private:
  /// A face with the pair whose bisector it lies in, or the flat patch of the surface.
  struct ListedFace {
    Index a, b;  // owners now; b is -1 on the boundary
    Index low, high;
    Index cell;  // of which `piece` is a face; positions in it are relative to its particle
    int sign;    // -1 where the piece's area points from b to a
    const FlatArea* piece;
    const Symmetric3* second;
  };

  Index side_of(const ListedFace& face) const { return planes_.side[static_cast<std::size_t>(face.low)]; }
  std::tuple<Index, Index, Index, Index> key(const ListedFace& face) const;
  FlatPiece together(std::span<const ListedFace> pieces) const;
  void add_face(const ListedFace& f, const FlatPiece& piece, Cells& cells) const;
  InteriorFace interior_face(const ListedFace& f, const Vec3& area, const Vec3& centroid) const;

  const Generators& points_;
  const SurfacePlanes& planes_;
  std::vector<ListedFace> listed_;
};

}  // namespace tessera
