#pragma once

#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// The particles around one, ring by ring: those with a common face, their neighbours, and theirs.
class NeighbourRings {
 public:
  /// Those with a common face.
  void start(const Discretization& d, Index a);
  /// All within so many rings, in any order but that those with a common face are the first.
  void widen(const Discretization& d, int rings);
  /// Leaves out what is beyond so many of those rings.
  void cut(int rings);
  /// Puts the far ones, which have no face in common, in order, nearest first.
  void sort_far();

  std::span<const Index> particles() const { return particles_; }
  std::span<const Vec3> branches() const { return branches_; }  // to them, X_ab
  std::size_t near() const { return ends_.front(); }
  std::size_t far() const { return particles_.size() - near(); }

  /// Is the next particle as far as the last of so many far ones? Taken together, lattices keep their symmetry.
  bool ends_within_equals(std::size_t far) const;

 private:
  bool see(Index a);
  void add(const Discretization& d, Index b);

  Index centre_ = 0;
  std::vector<Index> particles_;
  std::vector<Vec3> branches_;
  std::vector<std::size_t> ends_;  // of the rings
  std::vector<char> seen_;         // of all particles, zero but during a search
  std::vector<std::size_t> order_;
};

}  // namespace tessera
