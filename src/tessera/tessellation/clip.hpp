#pragma once

#include <span>
#include <utility>
#include <vector>

#include "tessera/base/index.hpp"
#include "tessera/geometry/solid.hpp"

namespace tessera {

/// A convex polyhedron as faces around vertices. Each face lists its vertices counter-clockwise seen from outside and
/// carries a tag that says whose plane it lies in.
struct ConvexPolyhedron {
  std::vector<Vec3> vertices;   // [m]
  std::vector<Index> tags;      // one per face
  std::vector<Index> begin{0};  // where each face's vertices begin in `corners`, and the end
  std::vector<Index> corners;   // vertices of all faces, one face after the other

  Index faces() const { return static_cast<Index>(tags.size()); }
  bool is_empty() const { return tags.empty(); }
  std::span<const Index> face(Index f) const {
    const auto i = static_cast<std::size_t>(f);
    return {corners.data() + begin[i], static_cast<std::size_t>(begin[i + 1] - begin[i])};
  }
  void clear();
  /// Ends the face whose vertices were appended to `corners`.
  void close_face(Index tag);
};

/// Cuts polyhedra by planes, again and again, without allocating each time.
class Clipper {
 public:
  explicit Clipper(double tolerance) : tolerance_(tolerance) {}

  enum class Outcome { untouched, cut, emptied };

  /// Keeps what is below `plane`; the new face gets `tag`. A vertex within the tolerance of the plane lies on it: it is
  /// neither cut off nor moved, so a face that coincides with the plane is not split into slivers.
  Outcome clip(ConvexPolyhedron& polyhedron, const Plane& plane, Index tag);

  /// The same without tolerance, for a plane that both sides are cut by: what this keeps of a polyhedron and what it
  /// keeps when the plane faces the other way are exactly the whole, though a plane close to a face may split that face
  /// anyhow.
  Outcome split(ConvexPolyhedron& polyhedron, const Plane& plane, Index tag);

  /// Lies face f in `plane`, to within the tolerance?
  bool lies_in(const ConvexPolyhedron& polyhedron, Index f, const Plane& plane) const;

 private:
  enum class Place : signed char { below, on, above };
  enum class Remains { joined, apart };  // of a face that the plane crosses more than twice

  Outcome cut(ConvexPolyhedron& polyhedron, Index tag);
  void cut_face(const ConvexPolyhedron& polyhedron, Index f);
  void cut_face_apart(const ConvexPolyhedron& polyhedron, Index f);
  void add_cap(Index tag);
  void keep_used_vertices();
  Index vertex_on_edge(const ConvexPolyhedron& polyhedron, Index u, Index v);
  Place place(Index v) const { return places_[static_cast<std::size_t>(v)]; }

  struct CutEdge {
    Index u, v, vertex;
  };

  double tolerance_;
  Remains remains_ = Remains::joined;
  std::vector<double> heights_;
  std::vector<Place> places_;  // of the old vertices, then of the new ones
  std::vector<CutEdge> cut_edges_;
  std::vector<std::pair<Index, Index>> rim_;  // edges of the hole that the cut leaves
  std::vector<Index> new_number_;
  ConvexPolyhedron result_;
};

}  // namespace tessera
