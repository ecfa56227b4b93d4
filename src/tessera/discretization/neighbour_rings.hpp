#pragma once

#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/discretization/discretization.hpp"

namespace tessera {

/// The particles around one: those with a common face, then neighbours of neighbours, nearest first.
class NeighbourRings {
 public:
  /// Those with a common face only.
  void find_near(const Discretization& d, Index a);
  /// Then all within so many rings, those with a common face being the first.
  void find_far(const Discretization& d, Index a, int within);

  std::span<const Index> particles() const { return particles_; }
  std::span<const Vec3> branches() const { return branches_; }  // to them, X_ab
  std::size_t near() const { return near_; }
  std::size_t far() const { return particles_.size() - near_; }

  /// Is the next particle as far as the last of so many far ones? Taken together, lattices keep their symmetry.
  bool ends_within_equals(std::size_t far) const;

 private:
  bool see(Index a);
  void sort_far(const Discretization& d, Index a);

  std::vector<Index> particles_;
  std::vector<Vec3> branches_;
  std::size_t near_ = 0;
  std::vector<char> seen_;  // of all particles, zero but during a search
};

}  // namespace tessera
